# Toolchain: for arm64 on another Debian machine, by g++-aarch64-linux-gnu and the libraries' packages of that architecture
# (dpkg --add-architecture arm64). scripts/test_arm64 makes such a Debian and calls this.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(ENV{PKG_CONFIG_LIBDIR} /usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig)
find_program(ROOMLIGHT_EMULATOR NAMES qemu-aarch64 qemu-aarch64-static)
if(ROOMLIGHT_EMULATOR)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${ROOMLIGHT_EMULATOR})
endif()
