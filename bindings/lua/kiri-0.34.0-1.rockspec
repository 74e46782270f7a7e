-- luarocks make, in a checkout: builds the library by make, with g++ and Eigen.
rockspec_format = "3.0"
package = "kiri"
version = "0.34.0-1"
source = {url = "git+file://."}
description = {
    summary = "Cuts thin sheets while they move: the library Kiri for LuaJIT and LOVE",
    license = "MIT",
}
supported_platforms = {"unix"}
dependencies = {"lua == 5.1"}
build = {
    type = "make",
    build_target = "lib",
    build_variables = {BUILD = "build/rock-build"},
    install_pass = false,
    install = {lua = {kiri = "bindings/lua/kiri.lua"}, lib = {libkiri = "build/rock-build/libkiri.so"}},
}
