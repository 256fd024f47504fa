"""Arrays in and out: shared memory, types that are taken, light that is known."""

import gc
import unittest
from types import SimpleNamespace

import numpy as np

import common
import roomlight
from roomlight import InputError, Material, Scene
from roomlight._common import rows


class PicturesAreMemoryOfTheLibrary(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.picture = roomlight.render(common.lit_cube(), **common.SMALL)

    def test_pixels_are_shared_and_read_only(self):
        pixels = self.picture.pixels
        self.assertEqual((pixels.shape, pixels.dtype), ((54, 96, 3), np.float32))
        self.assertTrue(np.shares_memory(pixels, self.picture.pixels))
        self.assertFalse(pixels.flags.owndata or pixels.flags.writeable)
        self.assertTrue(pixels.flags.c_contiguous)
        with self.assertRaises(ValueError):
            pixels[0, 0, 0] = 1
        with self.assertRaises(ValueError):
            pixels.flags.writeable = True

    def test_pixels_outlive_the_picture(self):
        picture = roomlight.render(common.lit_cube(), **common.SMALL)
        pixels, row = picture.pixels, picture.pixels[3]
        kept = pixels.copy()
        del picture
        gc.collect()
        others = [np.full((54, 96, 3), 7, np.float32) for _ in range(50)]  # would be written where it was
        self.assertTrue(np.array_equal(pixels, kept) and np.array_equal(row, kept[3]))
        self.assertEqual(len(others), 50)

    def test_display_is_not_copied_either(self):
        shown = self.picture.display()
        self.assertEqual((shown.shape, shown.dtype), ((54, 96, 3), np.uint8))
        self.assertFalse(shown.flags.owndata)
        shown[:] = 0  # the caller's own
        self.assertGreater(self.picture.display().max(), 0)

    def test_a_transparent_background_has_opacity(self):
        view = roomlight.View(eye=(9, 9, 9), target=(1, 1, 1), backdrop="none")
        shown = roomlight.render(common.lit_cube(), view=view, **common.SMALL).display()
        self.assertEqual(shown.shape, (54, 96, 4))
        self.assertEqual(shown[0, 0, 3], 0)


class ArraysOfAnyType(unittest.TestCase):
    def test_arrays_that_fit_are_not_copied(self):
        vertices = np.zeros((5, 3), np.float32)
        self.assertTrue(np.shares_memory(rows(vertices, 3, "vertices"), vertices))

    def test_the_type_does_not_change_the_picture(self):
        pixels = [roomlight.render(common.lit_cube(common.cube(dtype=dtype)), **common.SMALL).pixels for dtype in (
            (np.float32, np.uint32), (np.float64, np.int64), (np.float32, np.int32), (np.float64, np.uint8))]
        for other in pixels[1:]:
            self.assertTrue(np.array_equal(pixels[0], other))

    def test_layouts_other_than_rows_are_taken(self):
        meshes = common.cube()
        for mesh in meshes:
            mesh.vertices = np.asfortranarray(mesh.vertices)
            mesh.faces = np.repeat(mesh.faces, 2, axis=0)[::2]
        self.assertEqual(common.lit_cube(meshes).triangle_count, 12)

    def test_lists_dicts_trimesh_and_open3d(self):
        usual = common.lit_cube()
        for make in (lambda m: {"vertices": m.vertices.tolist(), "faces": m.faces.tolist()},
                     lambda m: SimpleNamespace(vertices=m.vertices.astype(float), faces=m.faces.astype(np.int64)),
                     lambda m: SimpleNamespace(vertices=Vectors(m.vertices), triangles=Vectors(m.faces.astype(np.int32)))):
            scene = common.lit_cube([make(m) for m in common.cube()])
            self.assertEqual((scene.triangle_count, scene.bounds), (usual.triangle_count, usual.bounds))

    def test_the_arrays_are_the_callers_again(self):
        meshes = common.cube()
        scene = common.lit_cube(meshes)
        for mesh in meshes:
            mesh.vertices[:] = np.nan
        self.assertTrue(np.isfinite(roomlight.render(scene, **common.SMALL).pixels).all())

    def test_textures_colour_what_they_cover(self):
        floor = common.rectangle([0, 0, 3], [3, 0, 0], [0, 0, -3])
        floor.uv = [[0, 0], [1, 0], [1, 1], [0, 1]]
        red = np.zeros((4, 4, 3), np.uint8)
        red[..., 0] = 255
        scene = common.lit_cube([floor], materials=[Material((1, 1, 1), specular=0, texture=0)], textures=[red])
        pixels = roomlight.render(scene, view=roomlight.View(eye=(1.5, 2, 1.6), target=(1.5, 0, 1.5)), **common.SMALL).pixels
        self.assertGreater(pixels[27, 48, 0], 0)
        self.assertEqual(pixels[27, 48, 1:].max(), 0)


class Vectors:
    """Like Open3D's, arrays by numpy.asarray alone."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None):
        return self.array if dtype is None else self.array.astype(dtype)


class ArraysThatDoNotFit(unittest.TestCase):
    def refused(self, what, **changes):
        mesh = common.rectangle([0, 0, 0], [1, 0, 0], [0, 0, -1])
        for name, value in changes.items():
            setattr(mesh, name, value)
        with self.assertRaisesRegex(InputError, what) as caught:
            Scene.from_arrays([mesh])
        self.assertIsInstance(caught.exception, ValueError)
        self.assertEqual(caught.exception.kind, "bad input")

    def test_messages_name_what_is_wrong(self):
        self.refused(r"vertices: must have the shape \(n, 3\), and has \(4, 2\)", vertices=np.zeros((4, 2)))
        self.refused(r"faces must have the shape \(m, 3\)", faces=np.zeros((2, 4), int))
        self.refused("faces must be whole numbers", faces=np.zeros((2, 3)))
        self.refused("faces name vertex -1", faces=[[0, 1, -1]])
        self.refused("faces name vertex 4, and there are 4", faces=[[0, 1, 4]])
        self.refused("there is no material 3", material=3)
        self.refused("normals: has 9 numbers, 4 vertices need 12", normals=np.ones((3, 3)))
        self.refused("uv: must have the shape", uv=np.ones((4, 3)))
        self.refused("mesh 0", vertices=np.full((4, 3), np.nan))

    def test_other_things_that_do_not_fit(self):
        for what, make in (
                ("has no vertices and faces", lambda: Scene.from_arrays([3])),
                ("unexpected keyword argument 'corners'", lambda: Scene.from_arrays([{"corners": 3}])),
                ("texture 0: must be uint8", lambda: common.lit_cube(textures=[np.zeros((4, 4, 3))])),
                ("metres_per_unit: must be above 0", lambda: common.lit_cube(metres_per_unit=-1)),
                ("lighting: ", lambda: Scene.from_arrays(common.cube(), lighting={"lamp": []})),
                ("light dusk: no such light", lambda: Scene.from_arrays(common.cube(), light="dusk"))):
            with self.subTest(what), self.assertRaisesRegex(InputError, what):
                make()
        with self.assertRaisesRegex(TypeError, "roughness: 'high'"):
            common.lit_cube(materials=[Material(roughness="high")])


class LightThatIsKnown(unittest.TestCase):
    def test_a_plate_under_a_uniform_sky(self):
        plate = common.rectangle([-1, 0, 1], [2, 0, 0], [0, 0, -2])
        scene = Scene.from_arrays([plate], lighting={"sky": {"luminance": "1000 cd/m2"}})
        lux = roomlight.illuminance(scene, [[0, 0.001, 0], [0.5, 0.001, 0.5]], technique="path", tolerance=0.002)
        np.testing.assert_allclose(lux, np.pi * 1000, rtol=0.01)

    def test_a_furnace(self):
        # Every side reflects half and gives 100 cd/m²: 200 cd/m² everywhere, π times that in lux.
        scene = Scene.from_arrays(common.cube(), materials=[Material((0.5, 0.5, 0.5), specular=0, emission=100)],
                                  cameras=[common.CAMERA])
        lux = roomlight.illuminance(scene, [[1.5, 0.002, 1.5], [0.7, 0.002, 2.1]], technique="path", tolerance=0.002)
        np.testing.assert_allclose(lux, np.pi * 200, rtol=0.01)
        pixels = roomlight.render(scene, technique="path", samples=64, width=32, height=18).pixels
        self.assertLess(abs(pixels.mean() / 200 - 1), 0.01)

    def test_units_of_vertices(self):
        scene = Scene.from_arrays(common.cube(300), metres_per_unit=0.01, light="day")
        np.testing.assert_allclose(scene.bounds[1], (3, 3, 3), rtol=1e-6)


if __name__ == "__main__":
    unittest.main()
