"""What pyproject.toml cannot say: which of CMake's targets are built and installed into the wheel."""
import os

from skbuild import setup

# the module alone, not the program: without a target scikit-build makes all of them
os.environ["SKBUILD_BUILD_OPTIONS"] = f"wormdrive_python {os.environ.get('SKBUILD_BUILD_OPTIONS', '')}"

setup(
    packages=["wormdrive"],
    package_dir={"": "bindings/python"},
    cmake_args=["-DWORMDRIVE_PYTHON_DIR=wormdrive", "-DWORMDRIVE_TESTS=OFF", "-DWORMDRIVE_BENCH=OFF"],
    cmake_install_dir="bindings/python",
    cmake_install_target="wormdrive_python_install",
)
