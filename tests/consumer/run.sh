#!/bin/sh
# Builds the README's first program, in build/single, in each way that the library can be used: from its folder,
# installed, by pkg-config, by CMake, and from its sources. CONFIG, CC, CXX and EIGEN are those of the Makefile.
set -eu
cd "$(dirname "$0")/../.."
root=$PWD
library="$root/build/$CONFIG"
program="$root/build/single/example.c"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES

fail() {
    echo "consumers: $*" >&2
    [ ! -s "$folder/log" ] || sed 's/^/    /' "$folder/log" >&2
    exit 1
}
quietly() {
    "$@" > "$folder/log" 2>&1 || fail "failed: $*"
}
# Runs a program, which has to find the shared library in a folder, or without one.
runs() { # program, folder
    LD_LIBRARY_PATH=${2:-} "$1" > "$folder/log" 2>&1 || fail "$1 does not run"
    grep -qx '2 pieces' "$folder/log" || fail "$1 does not do what it should"
}
not_shared() { ! LD_LIBRARY_PATH= ldd "$1" 2> /dev/null | grep -q libkiri || fail "$1 needs the shared library"; }
shared() {
    LD_LIBRARY_PATH= ldd "$1" | grep -q "libkiri.so.$soversion => not found" || fail "$1 does not need libkiri.so.$soversion"
}
install_to() { quietly make config="$CONFIG" CC="$CC" CXX="$CXX" EIGEN="$EIGEN" "$@"; }

# ---- Where it was built ---------------------------------------------------------------------------------------------

soversion=$(readlink "$library/libkiri.so" | sed 's/^libkiri.so.//')
version=$(readlink "$library/libkiri.so.$soversion" | sed 's/^libkiri.so.//')
quietly $CC -I"$root/include" "$program" "$library/libkiri.a" -lstdc++ -lm -o "$folder/plain"
not_shared "$folder/plain"
runs "$folder/plain"
quietly $CC -I"$root/include" "$program" -L"$library" -lkiri -o "$folder/plain_shared"
shared "$folder/plain_shared"
runs "$folder/plain_shared" "$library"

# ---- Installed ------------------------------------------------------------------------------------------------------

# For a package: below DESTDIR, in folders of its own. Nothing is left when it is taken away.
stage="DESTDIR=$folder/stage PREFIX=/usr libdir=/usr/lib/here"
install_to $stage install
(cd "$folder/stage" && find . ! -type d | LC_ALL=C sort) > "$folder/files"
cat > "$folder/expected" << END
./usr/include/kiri/kiri.h
./usr/lib/here/cmake/kiri/kiri-config-version.cmake
./usr/lib/here/cmake/kiri/kiri-config.cmake
./usr/lib/here/libkiri.a
./usr/lib/here/libkiri.so
./usr/lib/here/libkiri.so.$soversion
./usr/lib/here/libkiri.so.$version
./usr/lib/here/pkgconfig/kiri.pc
END
cmp -s "$folder/files" "$folder/expected" || fail "installed are other files: $(diff "$folder/expected" "$folder/files")"
! grep -q "@\|$folder" "$folder/stage/usr/lib/here/pkgconfig/kiri.pc" || fail 'kiri.pc has a wrong path'
install_to $stage uninstall
[ -z "$(find "$folder/stage" ! -type d)" ] || fail "uninstall leaves $(find "$folder/stage" ! -type d)"

prefix="$folder/with space [1]"
install_to PREFIX="$prefix" install

# ---- By pkg-config --------------------------------------------------------------------------------------------------

if command -v pkg-config > /dev/null; then
    export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
    quietly pkg-config --exact-version="$version" kiri
    eval "quietly $CC '$program' $(pkg-config --cflags --libs kiri) -o '$folder/by_pkg'"
    shared "$folder/by_pkg"
    runs "$folder/by_pkg" "$prefix/lib"
    eval "quietly $CC -static '$program' $(pkg-config --static --cflags --libs kiri) -o '$folder/by_pkg_static'"
    not_shared "$folder/by_pkg_static"
    runs "$folder/by_pkg_static"
else
    echo "consumers: no pkg-config, kiri.pc not tested"
fi

# ---- By CMake -------------------------------------------------------------------------------------------------------

if ! command -v cmake > /dev/null; then
    echo "consumers: no cmake, its package not tested"
    exit 0
fi
configure() { # folder below, options of CMake
    build="$folder/$1"
    shift
    CC=$CC CXX=$CXX cmake -S "$root/tests/consumer" -B "$build" -DSOURCE="$program" \
        -DCMAKE_PREFIX_PATH="$prefix" "$@" > "$folder/log" 2>&1
}
build() {
    configure "$@" || fail "cmake does not configure $*"
    quietly cmake --build "$folder/$1"
    program_built="$folder/$1/consumer"
}
build static -DWANTED="$version"
not_shared "$program_built"
runs "$program_built"
build static_of_c++ -DLANGUAGE="C;CXX" -DLIBRARY=kiri::static
not_shared "$program_built"
runs "$program_built"
build shared -DBUILD_SHARED_LIBS=ON -DWANTED="${version%.*}" -DCMAKE_SKIP_RPATH=ON
shared "$program_built"
runs "$program_built" "$prefix/lib"
mv "$prefix" "$folder/moved"
prefix="$folder/moved"
build moved -DLIBRARY=kiri::shared -DCMAKE_SKIP_RPATH=ON
shared "$program_built"
runs "$program_built" "$prefix/lib"
! configure later -DWANTED=1000.0 || fail 'cmake takes a version that is too old'
! configure earlier -DWANTED=0.4 || fail 'cmake takes a version with another interface'

# From the sources: without optimisation, for speed, and through a cache of compilers where there is one.
cache=$(command -v ccache || true)
build source -DFROM="$root" -DKIRI_EIGEN="$EIGEN" \
    ${cache:+-DCMAKE_C_COMPILER_LAUNCHER=$cache -DCMAKE_CXX_COMPILER_LAUNCHER=$cache}
not_shared "$program_built"
runs "$program_built"

# ---- Ports: vcpkg's and Conan's go through CMake, Meson's has its own build -----------------------------------------

# The port of vcpkg, with what its calls do: configure, build, install.
grep -q "\"version\": \"$version\"" bindings/vcpkg/vcpkg.json || fail 'the port of vcpkg has another version'
cat > "$folder/vcpkg.cmake" << END
set(CURRENT_PORT_DIR "$root/bindings/vcpkg")
set(CURRENT_PACKAGES_DIR "$folder/packages")
function(run)
    execute_process(COMMAND \${ARGN} RESULT_VARIABLE result)
    if(result)
        message(FATAL_ERROR "\${ARGN}")
    endif()
endfunction()
function(vcpkg_cmake_configure name path)
    run(cmake -S "\${path}" -B "$folder/vcpkg" "-DCMAKE_INSTALL_PREFIX=$folder/packages" "-DKIRI_EIGEN=$EIGEN"
        ${cache:+-DCMAKE_C_COMPILER_LAUNCHER=$cache -DCMAKE_CXX_COMPILER_LAUNCHER=$cache})
endfunction()
function(vcpkg_cmake_install)
    run(cmake --build "$folder/vcpkg" --target install)
endfunction()
function(vcpkg_cmake_config_fixup)
endfunction()
function(vcpkg_install_copyright name file)
    file(COPY "\${file}" DESTINATION "$folder/packages/share/kiri")
endfunction()
END
printf 'include("%s")\n' "$root/bindings/vcpkg/portfile.cmake" >> "$folder/vcpkg.cmake"
CC=$CC CXX=$CXX quietly cmake -P "$folder/vcpkg.cmake"
[ -s "$folder/packages/share/kiri/LICENSE" ] || fail 'the port of vcpkg has no copyright'
prefix="$folder/packages"
build port -DWANTED="${version%.*}"
runs "$program_built"
! configure port_earlier -DWANTED=0.4 || fail 'cmake takes a port with another interface'

if command -v meson > /dev/null; then
    install_to package-meson
    mkdir -p "$folder/meson/subprojects"
    cp -r build/meson/* "$folder/meson/subprojects"
    cp "$program" "$folder/meson"
    printf '%s\n' "project('consumer', 'c')" "executable('consumer', 'example.c', dependencies: dependency('kiri', version: '$version'))" \
        > "$folder/meson/meson.build"
    for kind in static shared; do
        CC="${cache:+$cache }$CC" CXX="${cache:+$cache }$CXX" quietly meson setup -Doptimization=0 --default-library $kind "$folder/meson/$kind" "$folder/meson"
        quietly meson compile -C "$folder/meson/$kind"
        runs "$folder/meson/$kind/consumer"
    done
else
    echo "consumers: no meson, its wrap not tested"
fi

# Eigen is the machine's: nothing is fetched.
if command -v conan > /dev/null; then
    export CONAN_HOME="$folder/conan"
    quietly env -u CC -u CXX conan profile detect # it knows no compiler called cc
    printf '[platform_requires]\neigen/3.4.0\n' >> "$CONAN_HOME/profiles/default"
    quietly conan create bindings/conan --no-remote -s build_type=Debug
    quietly conan install --no-remote -s build_type=Debug --requires "kiri/$version" -g CMakeDeps -of "$folder/conan_found"
    build by_conan -DCMAKE_BUILD_TYPE=Debug -DCMAKE_FIND_PACKAGE_PREFER_CONFIG=ON -Dkiri_DIR="$folder/conan_found" -DLANGUAGE="C;CXX"
    runs "$program_built"
else
    echo "consumers: no conan, its recipe not tested"
fi
echo "consumers: the first program runs with the library of each kind"
