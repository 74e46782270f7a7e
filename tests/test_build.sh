#!/bin/sh
# Tests of the Makefile: what is made anew, what is said where something is missing, and paths with spaces and brackets.
# It works in folders of its own, with the CC and CXX that it is called with, and installs nothing. The library and
# kiri-run have to be there.
set -eu
cd "$(dirname "$0")/.."
root=$PWD
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES

fail() {
    echo "test_build: $*" >&2
    [ ! -s "$folder/log" ] || sed 's/^/    /' "$folder/log" >&2
    exit 1
}

run_make() { # in the present folder
    make "$@" > "$folder/log" 2>&1 || fail "make $* failed"
}

# ---- What is made anew ----------------------------------------------------------------------------------------------

# A library of two files, to be quick.
tree="$folder/a b [c]"
mkdir -p "$tree/src/core" "$tree/.ci" "$tree/include/kiri"
cp Makefile "$tree"
cp -r .ci "$tree"
cp -r bindings "$tree"
cp include/kiri/kiri.h "$tree/include/kiri"
cd "$tree"
source_of() { # name, value
    echo "#pragma GCC visibility push(default)"
    echo "int kiri$1(void); int kiri$1(void) { return $2; }"
}
source_of One VALUE > src/core/one.c
source_of Two 2 > src/core/two.c
{ echo 'extern "C" {'; source_of Three 3; echo '}'; } > src/core/three.cpp

# Whether the last make compiled a file, or did not.
compiled() {
    grep -q "^  src/core/$1\$" "$folder/log" || fail "$1 was not compiled again after $2"
}
rested() {
    ! grep -q '^  ' "$folder/log" || fail "something was made anew after $1"
}
has() {
    nm "build/release/$1" | grep -q " T $2\$"
}

run_make lib CFLAGS=-DVALUE=1
compiled one.c 'nothing was there'
run_make lib CFLAGS=-DVALUE=1
rested nothing
run_make lib CFLAGS=-DVALUE=5
compiled one.c 'other CFLAGS'
run_make lib CFLAGS='-DVALUE="(int)sizeof(\"a b\")"'
compiled one.c 'CFLAGS with quotes'
run_make lib CFLAGS='-DVALUE="(int)sizeof(\"a b\")"'
rested 'the same CFLAGS with quotes'
export CFLAGS=-DVALUE=1
run_make lib
run_make lib CXXFLAGS=-DNOTHING
compiled three.cpp 'other CXXFLAGS'
run_make lib
run_make lib CC="env ${CC:-cc}"
compiled one.c 'another CC'
run_make lib CXX="env ${CXX:-c++}"
compiled three.cpp 'another CXX'
run_make lib
run_make lib LDFLAGS=-Wl,-O1
grep -q libkiri.so "$folder/log" || fail 'other LDFLAGS linked nothing'
run_make lib
touch Makefile
run_make lib
compiled one.c 'the Makefile was edited'
run_make lib
rested nothing

mv src/core/two.c src/core/second.c
run_make lib
compiled second.c 'it was renamed'
for library in libkiri.a libkiri.so; do has $library kiriTwo || fail "$library lost what a renamed file has"; done
rm src/core/second.c
run_make lib
for library in libkiri.a libkiri.so; do
    ! has $library kiriTwo || fail "$library has what was deleted"
    has $library kiriOne && has $library kiriThree || fail "$library lost what was not deleted"
done
unset CFLAGS

# ---- What is missing ------------------------------------------------------------------------------------------------

# A machine that has nothing but what is in this folder. Its user is not root, until somebody says so.
bin="$folder/bin"
mkdir "$bin"
# The compilers themselves: a cache of compilers would look for them in PATH.
plain=$(echo "$PATH" | tr : '\n' | grep -v ccache | paste -sd :)
c=$(PATH=$plain command -v "${CC:-cc}")
cxx=$(PATH=$plain command -v "${CXX:-c++}")
for tool in sh env make cat cmp mv rm mkdir touch sed awk grep tr sort nm ar as ld ln; do
    ln -s "$(command -v $tool)" "$bin"
done
stub() { # name, what it does
    printf '#!/bin/sh\n%s\n' "$2" > "$bin/$1"
    chmod +x "$bin/$1"
}
stub id 'echo 1000'
printf '#!/bin/sh\nprintf "%%s\\n" "$*" >> "%s/installed"\n' "$folder" > "$bin/apt-get"
chmod +x "$bin/apt-get"
compilers() { # what is added to their command
    stub cc "exec $c $1\"\$@\""
    stub c++ "exec $cxx $1\"\$@\""
}

# What make says must be one line with these words, and then make's own that it gives up.
refuses() { # words, make's arguments
    words=$1
    shift
    if PATH=$bin make CC=cc CXX=c++ EIGEN="$folder/eigen" "$@" > "$folder/log" 2>&1; then fail "make $* did not fail"; fi
    grep -q "$words" "$folder/log" || fail "make $* does not say: $words"
    [ "$(grep -vc ' [*][*][*] ' "$folder/log")" = 1 ] || fail "make $* says more than a line"
}

refuses 'make lib needs gcc libc6-dev g++ libeigen3-dev .*apt-get install gcc libc6-dev g++ libeigen3-dev' lib
# Each target that the README names.
refuses 'make lib needs gcc' install
for target in example run play test love; do refuses "make $target needs .*gcc.*libeigen3-dev" $target; done
refuses 'make web needs .*gcc.*emscripten nodejs npm' web-serve PYTHON=none
refuses 'make love needs .* love ' love
refuses 'make pygame needs .*python3-cffi python3-pygame' pygame PYTHON=none
refuses 'make package-javascript needs .*emscripten nodejs npm.*' package-javascript PYTHON=none
compilers ''
refuses 'make lib needs libeigen3-dev ' lib
mkdir -p "$folder/eigen/Eigen"
touch "$folder/eigen/Eigen/Sparse"
PATH=$bin run_make CC=cc CXX=c++ lib EIGEN="$folder/eigen" CFLAGS=-DVALUE=1
draws_by() { # what samples draw by
    PATH=$bin make CC=cc CXX=c++ EIGEN="$folder/eigen" -pn packages-run 2> /dev/null | grep -q "^RENDERER := $1\$" ||
        fail "samples do not draw by $1"
}
# Without headers but the language's own, whatever this machine has.
compilers "-nostdinc -I$folder/headers "
mkdir "$folder/headers"
touch "$folder/headers/stdint.h" "$folder/headers/vector"
refuses 'make run needs libosmesa6-dev libpng-dev (' run
refuses 'make deps needs .*libbox2d-dev.* python3-cffi' deps PYTHON=none
mkdir "$folder/headers/GL" "$folder/headers/EGL"
stub id 'echo 0'
stub apt-cache 'exit 1' # a Debian without OSMesa
PATH=$bin run_make CC=cc CXX=c++ EIGEN="$folder/eigen" packages-run
grep -q 'install libegl-dev libgl-dev libpng-dev$' "$folder/installed" || fail 'root did not install EGL where OSMesa is gone'
rm "$folder/installed"
stub id 'echo 1000'
touch "$folder/headers/EGL/egl.h" "$folder/headers/GL/gl.h"
refuses 'make run needs libpng-dev (' run
draws_by egl
rm "$folder/headers/EGL/egl.h"
touch "$folder/headers/GL/osmesa.h"
draws_by osmesa
refuses 'make run needs libpng-dev (' run
[ ! -e "$folder/installed" ] || fail 'apt-get was called by one who is not root'
stub id 'echo 0'
PATH=$bin run_make CC=cc CXX=c++ EIGEN="$folder/eigen" packages-run
grep -q 'install libpng-dev$' "$folder/installed" || fail 'root did not install libpng-dev, or more than that'
rm "$folder/installed"
touch "$folder/headers/png.h"
PATH=$bin run_make CC=cc CXX=c++ EIGEN="$folder/eigen" packages-run
[ ! -s "$folder/log" ] && [ ! -e "$folder/installed" ] || fail 'something was done though nothing was missing'

# What is only wanted stops nobody, and asks nobody for a password.
mkdir "$folder/headers/box2d" "$folder/headers/SDL2"
touch "$folder/headers/box2d/box2d.h" "$folder/headers/SDL2/SDL.h" "$folder/headers/SDL2/SDL_ttf.h" "$folder/headers/cmocka.h"
stub id 'echo 1000'
stub sudo 'exit 1'
PATH=$bin run_make CC=cc CXX=c++ EIGEN="$folder/eigen" PYTHON=none packages-test
grep -q '^make test goes on without python3-cffi cmake pkg-config[^;]*; .*apt-get install' "$folder/log" ||
    fail 'make test does not say what it leaves out'

# ---- Coverage -------------------------------------------------------------------------------------------------------

# Of a program that runs three of the five lines of one file, all of another, and none of a third.
test_coverage() {
    tree="$folder/counted"
    mkdir -p "$tree/src/core" "$tree/build/src/core"
    cp "$root/tests/coverage.sh" "$tree"
    cd "$tree"
    printf 'int f(int a);\nint f(int a)\n{\n    if (a)\n        return 1;\n    a += 2;\n    return a;\n}\n' > src/core/half.c
    printf 'int f(int a);\nint main(void)\n{\n    return f(1) - 1;\n}\n' > src/core/whole.c
    echo 'extern int none;' > src/core/nothing.c
    for file in half whole nothing; do
        gcc -O0 --coverage -c src/core/$file.c -o build/src/core/$file.c.o
    done
    gcc --coverage build/src/core/*.o -o build/program
    counted() { # percent
        sh coverage.sh build "$1" > "$folder/log" 2>&1
    }
    ! counted 1 || fail 'coverage is enough where nothing was run'
    build/program
    counted 60 || fail 'coverage of 60 % is not enough for 60 %'
    grep -q '^ 60.00 % of    5  src/core/half.c$' "$folder/log" || fail 'coverage of a half is another one'
    grep -q '^100.00 % of    2  src/core/whole.c$' "$folder/log" || fail 'coverage of a whole is another one'
    ! counted 61 || fail 'coverage of 60 % is enough for 61 %'
    echo 'int g(int a);' > src/core/unbuilt.c
    ! counted 60 || fail 'coverage is enough with a file that is in no program'
}
if command -v gcc > /dev/null && command -v gcov > /dev/null; then
    test_coverage
else
    echo 'test_build: no gcc, coverage not tested'
fi

# ---- A path with spaces and brackets --------------------------------------------------------------------------------

# All of the repository, with what is built already: times of files are kept, so that little is made anew.
tree="$folder/all of it [d]"
mkdir -p "$tree/build/release"
cd "$root"
for part in Makefile README.md LICENSE .ci include src bindings samples tests; do cp -a "$part" "$tree"; done
(cd build/release && cp -a compile.txt link.txt libkiri.* src samples "$tree/build/release")
cd "$tree"
touch src/core/kiri_base.c
run_make lib
run_make run ARGS="--ticks 2 --every 1 --size 160x120"
[ -s build/pictures/contact_sheet.png ] || fail 'no picture'
run_make floors exports
run_make python

# ---- What would be done ---------------------------------------------------------------------------------------------

# It is only said, also where nothing is built.
find build | sort > "$folder/before"
for target in check gallery-engines portable; do run_make -n config=release BUILD=build/nowhere $target; done
rm -rf build/nowhere
find build | sort | cmp -s "$folder/before" - || fail 'make -n makes something'
echo "test_build: stale builds, missing packages, paths and make -n: as it should be"
