"""Long calls: progress, exceptions, Ctrl-C, and other threads of Python meanwhile."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
import unittest

import numpy as np

import common
import roomlight

ENDLESS = {"technique": "path", "samples": 100_000, "width": 640, "height": 360}
WITHIN_S = 2.0 * max(1.0, os.getloadavg()[0] / os.cpu_count())  # two seconds where nothing else runs


class Told(Exception):
    pass


class ProgressIsTold(unittest.TestCase):
    def test_stages_and_fractions(self):
        told = []
        roomlight.render(common.lit_cube(), progress=lambda stage, fraction: told.append((stage, fraction)), **common.SMALL)
        self.assertIn("gather", {stage for stage, _ in told})
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in told))

    def test_an_exception_ends_the_work(self):
        def tell(stage, fraction):
            raise Told(stage)
        for work in (lambda: roomlight.render(common.lit_cube(), progress=tell, **ENDLESS),
                     lambda: roomlight.measure(roomlight.open(common.sample_room(), common.NIGHT), progress=tell),
                     lambda: roomlight.Meters(common.lit_cube(), progress=tell)):
            start = time.monotonic()
            with self.assertRaises(Told):
                work()
            self.assertLess(time.monotonic() - start, 5)

    def test_false_keeps_the_best_so_far(self):
        start = time.monotonic()
        def tell(stage, fraction):
            return time.monotonic() - start < 1
        picture = roomlight.render(common.lit_cube(), progress=tell, **ENDLESS)
        self.assertFalse(picture.complete)
        self.assertGreater(picture.pixels.mean(), 0)

    def test_false_where_there_is_nothing_yet(self):
        with self.assertRaises(roomlight.Interrupted) as caught:
            roomlight.Meters(common.lit_cube(), progress=lambda stage, fraction: False)
        self.assertEqual(caught.exception.kind, "interrupted")

    def test_callbacks_may_use_the_module(self):
        scene, seen = common.lit_cube(), []
        def tell(stage, fraction):
            if not seen:
                seen.append(roomlight.render(scene, **common.SMALL))
        picture = roomlight.render(scene, progress=tell, **common.SMALL)
        self.assertTrue(np.array_equal(picture.pixels, seen[0].pixels))


class ThreadsOfPython(unittest.TestCase):
    def test_two_render_at_once(self):
        scenes = [common.lit_cube(), roomlight.open(common.sample_room(), common.NIGHT)]
        alone = [roomlight.render(scene, **common.SMALL).pixels for scene in scenes]
        together = [[], []]
        def work(i):
            for _ in range(3):
                together[i].append(roomlight.render(scenes[i], progress=lambda s, f: None, **common.SMALL).pixels)
        threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i in range(2):
            self.assertEqual(len(together[i]), 3)
            for pixels in together[i]:
                self.assertTrue(np.array_equal(pixels, alone[i]))

    def test_a_renderer_serves_two(self):
        renderer = roomlight.Renderer(common.lit_cube(), ["Corner", roomlight.View(eye=(1, 1, 1), target=(2, 1, 2))],
                                      **common.SMALL)
        self.assertEqual(len(renderer), 2)
        out = {}
        threads = [threading.Thread(target=lambda i=i: out.update({i: renderer.picture(i).pixels})) for i in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for i, picture in enumerate(renderer):
            self.assertTrue(np.array_equal(out[i], picture.pixels))

    def test_others_run_meanwhile(self):
        steps, done = [0], threading.Event()
        def count():
            while not done.is_set():
                steps[0] += 1
                time.sleep(0.005)
        thread = threading.Thread(target=count)
        thread.start()
        start = time.monotonic()
        roomlight.render(common.lit_cube(), progress=lambda s, f: time.monotonic() - start < 1, **ENDLESS)
        done.set()
        thread.join()
        self.assertGreater(steps[0], 50)  # of 200 on an idle machine


def end(group):
    """A process with all that it has forked."""
    try:
        os.killpg(group, signal.SIGKILL)
    except ProcessLookupError:
        pass


class Interruption(unittest.TestCase):
    def child(self, work):
        code = textwrap.dedent("""
            import sys, threading, time
            sys.path.insert(0, sys.argv[1])
            import common, roomlight
            def begun(stage, fraction):
                global told
                if not told:
                    print("begun", flush=True)
                    told = True
            told = False
            ENDLESS = {"technique": "path", "samples": 100_000, "width": 640, "height": 360}
            """) + textwrap.dedent(work)
        child = subprocess.Popen([sys.executable, "-c", code, os.path.dirname(__file__)], text=True, cwd=common.ROOT,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        self.addCleanup(child.wait)
        self.addCleanup(end, child.pid)  # whatever has become of the test
        self.addCleanup(child.stdout.close)
        self.addCleanup(child.stderr.close)
        self.assertEqual(child.stdout.readline(), "begun\n")
        return child

    def ended(self, child):
        start = time.monotonic()
        child.send_signal(signal.SIGINT)
        said = child.communicate(timeout=60)[1]
        self.assertLess(time.monotonic() - start, WITHIN_S)
        return said

    def test_a_render_ends_by_keyboard_interrupt(self):
        child = self.child("roomlight.render(common.lit_cube(), progress=begun, **ENDLESS)")
        time.sleep(0.5)
        said = self.ended(child)
        self.assertEqual(child.returncode, -signal.SIGINT)
        self.assertTrue(said.rstrip().endswith("KeyboardInterrupt"), said)

    def test_python_goes_on_after_it(self):
        child = self.child("""
            try:
                roomlight.render(common.lit_cube(), progress=begun, **ENDLESS)
            except KeyboardInterrupt:
                print(roomlight.render(common.lit_cube(), width=16, height=9, quality="draft").pixels.mean() > 0)
            """)
        child.send_signal(signal.SIGINT)
        self.assertEqual(child.communicate(timeout=60)[0], "True\n")
        self.assertEqual(child.returncode, 0)

    def test_measure_ends_too(self):
        child = self.child("""
            scene = roomlight.open(common.ROOM, common.NIGHT)
            roomlight.measure(scene, technique="path", quality="best", tolerance=0.0001, progress=begun)
            """)
        time.sleep(1)
        self.assertIn("KeyboardInterrupt", self.ended(child))

    def test_waiting_for_another_threads_picture_ends(self):
        child = self.child("""
            renderer = roomlight.Renderer(common.lit_cube(), **ENDLESS)
            threading.Thread(target=lambda: renderer.picture(progress=begun), daemon=True).start()
            while not told:
                time.sleep(0.01)
            renderer.picture()
            """)
        time.sleep(0.5)
        self.assertIn("KeyboardInterrupt", self.ended(child))
        self.assertEqual(child.returncode, -signal.SIGINT)

    def test_a_process_that_ends_takes_its_threads_along(self):
        child = self.child("""
            threading.Thread(target=lambda: roomlight.render(common.lit_cube(), progress=begun, **ENDLESS), daemon=True).start()
            while not told:
                time.sleep(0.01)
            """)
        start = time.monotonic()
        said = child.communicate(timeout=60)
        self.assertLess(time.monotonic() - start, WITHIN_S)
        self.assertEqual(child.returncode, 0, said)

    def test_a_process_that_ends_waits_for_what_cannot_be_cancelled(self):
        child = self.child("""
            ready = threading.Event()
            def work():
                begun("open", 0)
                ready.set()
                while True:
                    roomlight.open(common.ROOM, common.NIGHT)
            threading.Thread(target=work, daemon=True).start()
            ready.wait()
            time.sleep(0.3)
            """)
        said = child.communicate(timeout=120)
        self.assertEqual(child.returncode, 0, said)

    def test_a_forked_process_ends(self):
        child = self.child("""
            import os
            threading.Thread(target=lambda: roomlight.render(common.lit_cube(), progress=begun, **ENDLESS), daemon=True).start()
            while not told:
                time.sleep(0.01)
            forked = os.fork()
            if forked:
                os.waitpid(forked, 0)
            """)
        said = child.communicate(timeout=60)
        self.assertEqual(child.returncode, 0, said)


if __name__ == "__main__":
    unittest.main()
