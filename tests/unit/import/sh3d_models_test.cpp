// Models of Sweet Home 3D's homes in other formats than OBJ, and what was saved of each content.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <span>
#include <string_view>

#include "import/sh3d_content.h"
#include "unit/import/sh3d_file.h"

namespace roomlight {
namespace {

using namespace testing;
using namespace importers;

std::string piece(const std::string& model, const std::string& inside = "") {
  return "<pieceOfFurniture name='piece' x='300' y='200' width='100' depth='50' height='80' model='" + model + "'>" +
         inside + "</pieceOfFurniture>";
}

Imported imported(const std::string& elements, const ZipEntries& more) {
  Result<Imported> r = importHome(elements, more);
  if (!r) {
    ADD_FAILURE() << r.error();
    return {};
  }
  return std::move(r.value());
}

bool warns(const Imported& i, const std::string& of) {
  for (const std::string& w : i.warnings) {
    if (w.find(of) != std::string::npos) return true;
  }
  return false;
}

// A wedge 2 wide, 3 high, 4 deep, z up: full width at its bottom, a ridge above its left side.
std::string collada(const std::string& node =
                        "<instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='s' "
                        "target='#m'/></technique_common></bind_material></instance_geometry>") {
  return "<?xml version='1.0' encoding='utf-8'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit meter='0.01'/><up_axis>Z_UP</up_axis></asset>"
         "<library_images><image id='i'><init_from>../images/red.bmp</init_from></image></library_images>"
         "<library_effects><effect id='e'><profile_COMMON><newparam sid='p'><surface "
         "type='2D'><init_from>i</init_from></surface></newparam>"
         "<newparam sid='q'><sampler2D><source>p</source></sampler2D></newparam><technique "
         "sid='t'><phong><diffuse><texture texture='q' texcoord='U'/></diffuse></phong></technique>"
         "</profile_COMMON></effect></library_effects><library_materials><material id='m' name='wood'><instance_effect "
         "url='#e'/></material></library_materials>"
         "<library_geometries><geometry id='g'><mesh><source id='v'><float_array id='va' count='18'>0 0 0 2 0 0 2 4 0 "
         "0 4 0 0 0 3 0 4 3</float_array>"
         "<technique_common><accessor source='#va' count='6' stride='3'><param name='X' type='float'/><param name='Y' "
         "type='float'/><param name='Z' type='float'/></accessor></technique_common></source>"
         "<source id='u'><float_array id='ua' count='2'>0.5 0.5</float_array><technique_common><accessor source='#ua' "
         "count='1' stride='2'><param name='S' type='float'/><param name='T' "
         "type='float'/></accessor></technique_common></source>"
         "<vertices id='vs'><input semantic='POSITION' source='#v'/></vertices><polylist material='s' count='5'><input "
         "semantic='VERTEX' source='#vs' offset='0'/><input semantic='TEXCOORD' source='#u' offset='1' set='0'/>"
         "<vcount>4 4 4 3 3</vcount><p>0 0 3 0 2 0 1 0 0 0 4 0 5 0 3 0 1 0 2 0 5 0 4 0 0 0 1 0 4 0 2 0 3 0 5 "
         "0</p></polylist></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id='vis'><node id='n' name='body'>" +
         node +
         "</node></visual_scene></library_visual_scenes><scene><instance_visual_scene url='#vis'/></scene></COLLADA>";
}

std::string word16(unsigned v) { return {static_cast<char>(v & 255), static_cast<char>(v >> 8 & 255)}; }
std::string word32(size_t v) {
  return word16(static_cast<unsigned>(v & 0xffff)) + word16(static_cast<unsigned>(v >> 16));
}
std::string chunk(unsigned id, const std::string& inside) { return word16(id) + word32(inside.size() + 6) + inside; }
std::string number(float v) {
  std::string s(4, '\0');
  std::memcpy(s.data(), &v, 4);
  return s;
}

// The same wedge: 3D Studio's z points up too.
std::string studio3d() {
  std::string vertices = word16(6), faces = word16(8);
  for (const float v :
       {0.0f, 0.0f, 0.0f, 2.0f, 0.0f, 0.0f, 2.0f, 4.0f, 0.0f, 0.0f, 4.0f, 0.0f, 0.0f, 0.0f, 3.0f, 0.0f, 4.0f, 3.0f})
    vertices += number(v);
  constexpr unsigned kFaces[8][3] = {{0, 3, 2}, {0, 2, 1}, {0, 4, 5}, {0, 5, 3},
                                     {1, 2, 5}, {1, 5, 4}, {0, 1, 4}, {2, 3, 5}};
  for (const auto& f : kFaces) faces += word16(f[0]) + word16(f[1]) + word16(f[2]) + word16(0);
  const std::string material = chunk(
      0xafff, chunk(0xa000, std::string("blue\0", 5)) + chunk(0xa020, chunk(0x0011, std::string("\x00\x00\xff", 3))));
  std::string users = std::string("blue\0", 5) + word16(8);
  for (unsigned i = 0; i < 8; ++i) users += word16(i);
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces + chunk(0x4130, users)));
  return chunk(0x4d4d,
               chunk(0x0002, word32(3)) + chunk(0x3d3d, material + chunk(0x4000, std::string("body\0", 5) + mesh)));
}

// A BMP of one red pixel.
std::string redBmp() {
  return "BM" + word32(58) + word32(0) + word32(54) + word32(40) + word32(1) + word32(1) + word16(1) + word16(24) +
         word32(0) + word32(4) + word32(0) + word32(0) + word32(0) + word32(0) + std::string("\x00\x00\xff\x00", 4);
}

// z up became y up: the piece's box is filled, and its ridge runs along its left side from front to back.
void expectWedge(const Scene& scene) {
  const Bounds3 b = boundsOf(scene, "piece");
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(b.lo[i], (Vec3{2.5f, 0, 1.75f}[i]), 1e-4) << i;
    EXPECT_NEAR(b.hi[i], (Vec3{3.5f, 0.8f, 2.25f}[i]), 1e-4) << i;
  }
  EXPECT_NEAR(volumeM3(scene, "piece"), 1 * 0.5 * 0.8 / 2, 1e-4);  // fronts look outwards
  EXPECT_NEAR(areaFacing(scene, "piece", {-1, 0, 0}), 0.5 * 0.8, 1e-4);
  EXPECT_NEAR(areaFacing(scene, "piece", {0, -1, 0}), 0.5, 1e-4);
}

TEST(Sh3dModels, colladaWithItsPicture) {
  const Imported i =
      imported(piece("7/models/wedge.dae"), {{"7/models/wedge.dae", collada()}, {"7/images/red.bmp", redBmp()}});
  expectWedge(i.scene);
  ASSERT_EQ(i.scene.textures.size(), 1u);
  EXPECT_EQ(i.scene.textures[0].rgba, (std::vector<uint8_t>{255, 0, 0, 255}));
  const std::vector<Face> faces = facesOf(i.scene, "piece");
  ASSERT_FALSE(faces.empty());
  const Material& m = i.scene.materials[static_cast<size_t>(faces[0].material)];
  EXPECT_EQ(m.baseColorTexture.texture, 0);
  EXPECT_NE(m.name.find("wood"), std::string::npos) << m.name;
  EXPECT_EQ(m.baseColor.x, 1);  // the picture stands in the place of the colour
}

TEST(Sh3dModels, colladaInAnArchiveOfItsOwn) {
  const std::string kmz =
      zipped({{"doc.kml", "<kml/>"}, {"models/wedge.dae", collada()}, {"images/red.bmp", redBmp()}});
  const Imported i = imported(piece("7"), {{"7", kmz}});
  expectWedge(i.scene);
  EXPECT_EQ(i.scene.textures.size(), 1u);
}

TEST(Sh3dModels, studio3D) {
  const Imported i = imported(piece("7"), {{"7", studio3d()}});
  expectWedge(i.scene);
  const std::vector<Face> faces = facesOf(i.scene, "piece");
  ASSERT_FALSE(faces.empty());
  const Material& m = i.scene.materials[static_cast<size_t>(faces[0].material)];
  EXPECT_GT(m.baseColor.z, 0.9f);
  EXPECT_LT(m.baseColor.x, 0.1f);
}

TEST(Sh3dModels, transformationsKnowColladasNodes) {
  const Imported i = imported(piece("7.dae", "<transformation name='body' matrix='1 0 0 0 0 1 0 0 0 0 1 0'/>"),
                              {{"7.dae", collada()}});
  EXPECT_FALSE(warns(i, "transformations"));
}

// A node that holds itself makes the library call itself without end.
TEST(Sh3dModels, whatEndsTheReaderEndsNotTheProgram) {
  const Imported cycle = imported(piece("7.dae"), {{"7.dae", collada("<instance_node url='#n'/>")}});
  EXPECT_TRUE(warns(cycle, "the model '7.dae'"));
  EXPECT_FALSE(facesOf(cycle.scene, "piece").empty());  // the box in its place
}

TEST(Sh3dModels, damagedForeignModelsStandAsBoxes) {
  for (const std::string& whole : {collada(), studio3d()}) {
    for (const size_t part : {3u, 40u, 300u}) {
      const Imported i = imported(piece("7"), {{"7", whole.substr(0, whole.size() * part / 400)}});
      EXPECT_FALSE(facesOf(i.scene, "piece").empty());
    }
  }
}

// Some archives hold themselves, and would be unpacked without end.
TEST(Sh3dModels, archivesAreOpenedOnce) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n", once = zipped({{"a.obj", obj}});
  EXPECT_EQ(facesOf(imported(piece("7"), {{"7", once}}).scene, "piece").size(), 1u);
  const Imported twice = imported(piece("7"), {{"7", zipped({{"a.obj", once}})}});
  EXPECT_TRUE(warns(twice, "is a zip file in a zip file"));
}

TEST(Sh3dModels, otherFormatsAreNamed) {
  EXPECT_TRUE(warns(imported(piece("7.lws"), {{"7.lws", "LWSC\n3\n"}}), "LightWave"));
  EXPECT_TRUE(warns(imported(piece("7.glb"), {{"7.glb", "glTF\2"}}), "glTF"));
}

std::string base64(const Sha1Digest& d) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < 20; i += 3) {
    const unsigned three =
        unsigned{d[i]} << 16 | (i + 1 < 20 ? unsigned{d[i + 1]} << 8 : 0) | (i + 2 < 20 ? d[i + 2] : 0u);
    for (size_t k = 0; k < 4; ++k) out += i + k > 20 ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return out;
}

std::span<const uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

std::string digestOf(const std::string& all) { return base64(sha1(std::array{bytesOf(all)})); }

// FIPS 180-4's example "abc", whole and in pieces.
TEST(Sh3dDigests, areThoseOfThePiecesOneAfterAnother) {
  EXPECT_EQ(digestOf("abc"), "qZk+NkcGgWq6PiVxeFDCbJzQ2J0=");
  EXPECT_EQ(base64(sha1(std::array{bytesOf("a"), bytesOf(""), bytesOf("bc")})), digestOf("abc"));
}

TEST(Sh3dDigests, contentsThatDifferAreTold) {
  const std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 1\nusemtl m\nf 1 2 3\n", mtl = "newmtl m\nKd 1 0 0\n";
  const auto digests = [&](const std::string& ofAll) {
    return "ContentDigests-Version: 1.0\n\nName: 7/a.obj\nSHA-1-Digest: " + ofAll + "\n\n";
  };
  const ZipEntries entries{{"7/a.obj", obj}, {"7/LICENSE.TXT", "free"}, {"7/a.mtl", mtl}};
  // Of all in the folder by name, a.mtl first, without the licence.
  ZipEntries good = entries, bad = entries, broken = entries;
  good.emplace_back("ContentDigests", digests(digestOf(mtl + obj)));
  bad.emplace_back("ContentDigests", digests(digestOf(obj)));
  broken.emplace_back("ContentDigests", digests("!!!"));
  EXPECT_FALSE(warns(imported(piece("7/a.obj"), good), "digest"));
  const Imported damaged = imported(piece("7/a.obj"), bad);
  EXPECT_TRUE(warns(damaged, "the model '7/a.obj' is not what was saved"));
  EXPECT_EQ(facesOf(damaged.scene, "piece").size(), 1u);  // it is shown all the same
  EXPECT_TRUE(warns(imported(piece("7/a.obj"), broken), "ContentDigests"));
}

TEST(Sh3dDigests, damagedPicturesLeaveTheHomeOpen) {
  const std::string room =
      "<room floorColor='FF808080'><texture attribute='floorTexture' name='t' image='5' width='50' height='50'/><point "
      "x='0' y='0'/><point x='100' y='0'/><point x='0' y='100'/></room>";
  const Imported good = imported(
      room,
      {{"5", redBmp()},
       {"ContentDigests", "ContentDigests-Version: 1.0\n\nName: 5\nSHA-1-Digest: " + digestOf(redBmp()) + "\n\n"}});
  EXPECT_FALSE(warns(good, "picture"));
  EXPECT_EQ(good.scene.textures.size(), 1u);
  const Imported other = imported(
      room, {{"5", redBmp()},
             {"ContentDigests", "ContentDigests-Version: 1.0\n\nName: 5\nSHA-1-Digest: " + digestOf("") + "\n\n"}});
  EXPECT_TRUE(warns(other, "the picture '5' is not what was saved"));
  const Imported cut = imported(room, {{"5", redBmp().substr(0, 40)}});
  EXPECT_TRUE(warns(cut, "picture"));
  EXPECT_TRUE(cut.scene.textures.empty());
}

}  // namespace
}  // namespace roomlight
