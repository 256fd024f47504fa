"""Types for checkers, and a docstring for whatever users see."""

import inspect
import subprocess
import unittest

import common
import roomlight

PYTHON = common.ROOT / "python"


class TypesAndDocuments(unittest.TestCase):
    def test_types_of_package_and_examples(self):
        found = subprocess.run(["mypy", "--strict", "--python-version", "3.11", "--cache-dir=/dev/null", PYTHON / "roomlight",
                                common.ROOT / "scripts/measure_python", PYTHON / "make_wheel.py", *sorted((PYTHON / "examples").glob("*.py"))],
                               capture_output=True, text=True, cwd=PYTHON)
        self.assertEqual(found.returncode, 0, found.stdout + found.stderr)

    def test_all_has_a_docstring(self):
        for name in roomlight.__all__:
            thing = getattr(roomlight, name)
            if inspect.isclass(thing) or inspect.isfunction(thing):
                self.assertTrue(thing.__doc__, name)
            if inspect.isclass(thing) and not issubclass(thing, tuple):
                for member, value in vars(thing).items():
                    if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                        self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_the_stub_has_what_the_module_has(self):
        tree = (PYTHON / "roomlight/_roomlight.pyi").read_text()
        module = roomlight._roomlight
        for name, thing in vars(module).items():
            if name.startswith("__"):
                continue
            self.assertTrue(f"class {name}:" in tree or f"def {name}(" in tree, name)
            if inspect.isclass(thing):
                body = tree.split(f"class {name}:")[1].split("\nclass ")[0]
                for member in vars(thing):
                    if not member.startswith("_"):
                        self.assertTrue(f"    {member}: " in body or f"    def {member}(" in body, f"{name}.{member}")

    def test_versions(self):
        self.assertRegex(roomlight.__version__, r"^\d+\.\d+\.\d+")
        self.assertRegex(roomlight.build_id(), r"^[0-9a-f]{16,}$")
        self.assertIn(".sh3d", roomlight.supported_files())
        self.assertIn("hybrid", roomlight.techniques())
        self.assertIn("draft", roomlight.qualities())


if __name__ == "__main__":
    unittest.main()
