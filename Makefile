# Kiri. GNU make.
#
#   make run      builds the library, cuts a bunny out of a hanging cloth, writes pictures to build/pictures
#   make box2d    cuts a strip that lies on bodies of Box2D
#   make play     plays a game in a window; GAME=curtain or net, ARGS=--help
#   make view     shows a recording or a save in a window; FILE=error.kiri
#   make test     builds and runs all tests; test-all: installs Mono, Godot, Xvfb and LuaJIT before, for all bindings
#   make quick    a few of them, with all calls: for config=debug beside config=sanitize
#   make check    limits, and half a minute of tests of what users meet first: after a change, or on a new machine
#   make limits   compares figures of the sources with their limits, which only get stricter; includes, fields; no build
#   make fuzz     looks for input that breaks something; FUZZ=mesh: other than calls; TIME=600: s
#   make sweep    loads saves that are wrong in one number; ARGS='35 36 1': of world 35; config=debug: asserts
#   make page     cuts pages of lines and compares the pieces with Shapely's; ARGS='10 1 2000': pages, first seed, lines
#   make long     ten minutes of play, 20 minutes of a slicing game, 6000 swipes of a blade, blades held for ten minutes
#   make analyze  gcc's analyzer, cppcheck and clang-tidy over src; deps-analyze: installs these; valgrind: a few tests
#   make scarce   refuses each request for memory of the scenes once
#   make tsan     runs the tests with threads under the thread sanitizer
#   make coverage says which part of the lines of each file the tests run
#   make lib      build/<config>/libkiri.a and libkiri.so
#   make single   build/single: the library as kiri.h, kiri.c and kiri.cpp, to add to any build
#   make bindings makes kiri.json, and what each language has of it, from the header
#   make install  library, header and packages of pkg-config and CMake; PREFIX=, DESTDIR=, libdir=; make uninstall
#   make abi      compares the binary interface with the last version's
#   make bench    runs the benchmarks; figures: measures what documents quote of them, and writes it there
#   make accuracy compares with references from outside; CASE=torsion: that one only
#   make trade    what accuracy costs: one page of curves for five materials in four scenes, with springs beside
#   make contact  measures contact against laws and peers; CASE=laws: that group only
#   make extremes runs what nobody should do to a sheet, and says what became of it
#   make gallery  renders the pictures of samples/README.md; make web-film: the film that the README begins with
#   make gallery-engines  pictures of the samples in other engines, from their tests
#   make guide    renders the pictures of src/README.md
#   make manual   compiles and runs the programs of the manual, and renders its pictures
#   make portable builds a storm for other machines and compilers, and compares bits; deps-portable: installs these
#   make deps     installs what is missing for all of these (Debian and its relatives)
#   make format   clang-format over all sources
#   make clean    removes build/
#   make help     prints these lines
#
#   config=release|debug|sanitize|thread|coverage|fuzz   default release
#   RENDERER=osmesa|egl   what samples and games draw by
#   WERROR=   warnings of a newer compiler are no errors
#   SCENE=name ARGS='--size 1280x960'   for run; ARGS=--help lists them

config ?= release
SCENE ?= bunny
GAME ?=
ARGS ?=
CASE ?=
FUZZ ?= calls

# Packages by what they are for, as Debian names them.
NEEDS_lib := gcc g++ libeigen3-dev
NEEDS_run := $(NEEDS_lib) libosmesa6-dev libpng-dev
NEEDS_box2d := $(NEEDS_run) libbox2d-dev
NEEDS_play := $(NEEDS_box2d) libsdl2-dev libsdl2-ttf-dev
WANTS_play := fonts-dejavu-core
NEEDS_view := $(NEEDS_run) libsdl2-dev libsdl2-ttf-dev
WANTS_view := fonts-dejavu-core
NEEDS_test := $(NEEDS_play) libcmocka-dev
NEEDS_tsan := $(NEEDS_lib) libcmocka-dev
NEEDS_check := $(NEEDS_lib) libcmocka-dev
NEEDS_fuzz := clang libclang-rt-dev $(NEEDS_lib) libcmocka-dev
NEEDS_bench := $(NEEDS_lib) libcmocka-dev
NEEDS_figures := $(NEEDS_bench) libbullet-dev
NEEDS_accuracy := $(NEEDS_lib)
NEEDS_trade := $(NEEDS_lib) python3-matplotlib
NEEDS_contact := $(NEEDS_lib) libbox2d-dev
NEEDS_extremes := $(NEEDS_lib)
NEEDS_gallery := $(NEEDS_play) python3-pil
NEEDS_guide := $(NEEDS_run)
NEEDS_manual := $(NEEDS_run)
NEEDS_portable := $(NEEDS_lib)
NEEDS_example := $(NEEDS_lib)
# Without these, tests of bindings are left out, with a line that says so.
WANTS_test := python3-cffi cmake pkg-config $(WANTS_play)
# Large ones; each language's rules add to them.
NEEDS_test-all = $(NEEDS_test)
WANTS_test-all := $(WANTS_test)
WANTS_gallery := $(WANTS_play)

BUILD := build/$(config)
ifndef EIGEN
EIGEN := $(or $(patsubst -I%,%,$(shell pkg-config --cflags-only-I eigen3 2>/dev/null)),/usr/include/eigen3)
endif

# Samples and games draw by OSMesa, or where Mesa (25.1 and later) has none, by EGL without a surface.
ifndef RENDERER
RENDERER := $(shell $(CC) -E -include GL/osmesa.h -x c /dev/null > /dev/null 2>&1 && echo osmesa || echo egl)
endif
GL_LIBRARIES := $(if $(filter egl,$(RENDERER)),-lEGL -lGL,-lOSMesa)

# Contraction to fused multiply-add would give other bits on other machines.
WERROR ?= -Werror
FLAGS := -Wall -Wextra -Wpedantic -Wshadow $(WERROR) -ffp-contract=off -fno-math-errno -fPIC -MMD -MP
FLAGS_release := -O3 -DNDEBUG
FLAGS_debug := -Og -g -DKIRI_ASSERTS
FLAGS_sanitize := -O2 -g1 -DKIRI_ASSERTS -fsanitize=address,undefined -fno-sanitize-recover=all
# With clang: `make fuzz` says so. Zero added to a null pointer is no error in C++, and none in the next C.
FLAGS_fuzz := -O1 -g -DKIRI_ASSERTS -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all \
              -fno-sanitize=pointer-overflow
FLAGS_thread := -O2 -g1 -DKIRI_ASSERTS -fsanitize=thread
# Lines of src are counted. At -O0 the programs take ten times as long.
FLAGS_coverage := $(FLAGS_release)
FLAGS_counted := -O1 --coverage
ifeq ($(FLAGS_$(config)),)
$(error config is release, debug, sanitize, thread, coverage or fuzz, not '$(config)')
endif
FLAGS += $(FLAGS_$(config))

# Of the library, from its header. Before 1.0 a minor version may change the interface, so it is in the shared library's
# name too.
VERSION := $(subst $() ,.,$(shell sed -n 's/.*define KIRI_VERSION_[MP][A-Z]* //p' include/kiri/kiri.h))
VERSION_PARTS := $(subst ., ,$(VERSION))
SOVERSION := $(firstword $(VERSION_PARTS))$(if $(filter 0,$(firstword $(VERSION_PARTS))),.$(word 2,$(VERSION_PARTS)))

COMPILE_C = $(CC) -std=c99 $(FLAGS) $(CFLAGS)
COMPILE_CXX = $(CXX) -std=c++14 $(FLAGS) $(CXXFLAGS)
LINK = $(CXX) $(FLAGS_$(config)) $(if $(filter coverage,$(config)),$(FLAGS_counted)) $(LDFLAGS)

# What takes longest to compile begins first.
LIBRARY_OBJECTS := $(patsubst %,$(BUILD)/%.o,$(wildcard src/*/*.cpp src/*/*.c))
SAMPLE_OBJECTS := $(patsubst %,$(BUILD)/%.o,$(wildcard samples/*.c))
GAME_OBJECTS := $(patsubst %,$(BUILD)/%.o,$(wildcard samples/games/*.c samples/games/*.cpp))
# Sheets that touch bodies of Box2D: for its sample, the game Net, and their tests.
ADAPTER_OBJECTS := $(BUILD)/samples/box2d/kiri_box2d.cpp.o
# Without window and main: for tests.
GAME_PARTS := $(filter-out %/main.c.o %/shell.c.o %/window.c.o,$(GAME_OBJECTS))
# Drawings to cut: SVG, DXF, FOLD.
IMPORT_OBJECTS := $(filter $(BUILD)/samples/import% %/export.c.o,$(SAMPLE_OBJECTS))
# What games and their tests share with the samples.
PICTURE_OBJECTS := $(patsubst %,$(BUILD)/samples/%.c.o,canvas canvas_body canvas_camera canvas_overlay image edges lines offscreen)
# What tests and benchmarks take from the samples: the scenes.
SCENE_OBJECTS := $(filter $(BUILD)/samples/scene% $(BUILD)/samples/import% %/creases.c.o %/outline.c.o %/sheets.c.o,$(SAMPLE_OBJECTS))
# Checks and hashes of a whole world, for all tests.
VALIDATE_OBJECTS := $(patsubst %,$(BUILD)/tests/%.c.o,validate validate_mesh validate_field validate_seen layout_hash)
TESTS := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/test_*.c)) $(patsubst %.cpp,$(BUILD)/%,$(wildcard tests/test_*.cpp))
# Each tests/fuzz_X.c, its input in tests/data/fuzz/X.
FUZZERS := calls load mesh replay spoil
# What `make accuracy` is made of beside its driver.
ACCURACY_PARTS := $(addprefix tests/,accuracy_beam accuracy_plate accuracy_shell accuracy_cut accuracy_motion specimen \
                  frame_layout results reference)
# What `make contact` is made of beside its driver.
CONTACT_PARTS := $(addprefix tests/,contact_laws contact_obstacles contact_rest contact_sheets contact_meetings contact_folds contact_bodies)
# What is measured of sheets among bodies of Box2D.
BOX2D_LAWS := $(BUILD)/tests/box2d_laws.cpp.o $(ADAPTER_OBJECTS)
BENCHES := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/bench*.c))
RUN := $(BUILD)/samples/kiri-run
BOX2D := $(BUILD)/samples/kiri-box2d
PLAY := $(BUILD)/samples/kiri-play
VIEW := $(BUILD)/samples/kiri-view
# The Python binding is tested where Python has cffi; a sanitized library cannot be loaded by a plain Python.
# Debian's own python has Debian's python3-cffi.
PYTHON ?= $(firstword $(wildcard /usr/bin/python3) python3)
PYTHON_CHECK := $(if $(filter sanitize thread,$(config)),,python)
# What is made from the header, the programs of the manual, tests of the Makefile itself and of what it installs, and
# what does not depend on the options of the compiler: once. Those that take longest begin first.
ONCE := $(if $(filter release,$(config)),consumers manual-programs exported builds example headers described unrun float-guards limits renderers)

# What was made by other commands, or by another Makefile, is made anew: objects depend on a file with the text of the
# commands, the library on one with the lists of objects, and all that is linked on the library.
COMPILE_TEXT := $(COMPILE_C) | $(RENDERER) | $(COMPILE_CXX) | $(EIGEN) | $(FLAGS_counted)
LINK_TEXT := $(LINK) | $(VERSION) | $(AR) | $(LIBRARY_OBJECTS) | $(SAMPLE_OBJECTS) | $(GAME_OBJECTS)
TO_COMPILE := $(BUILD)/compile.txt Makefile
TO_LINK := $(BUILD)/link.txt Makefile

# Each language's rules; `make test` runs the targets that they add to LANGUAGE_CHECKS.
LANGUAGE_CHECKS :=
include bindings/install.mk $(wildcard bindings/*/rules.mk)

.PHONY: all run box2d jolt play view python bindings described builds exported renderers lib single example bench accuracy trade contact extremes gallery guide deps
.PHONY: unrun test test-all all-tests quick fuzz sweep scarce long page analyze deps-analyze valgrind tsan check limits ratchet floors fields quotes figures headers format clean exports FORCE
.DEFAULT_GOAL := all
.SECONDARY:
.DELETE_ON_ERROR:

all: lib

# What each target needs is installed where that may be, and else named in one line.
PACKAGES = CC='$(CC)' CXX='$(CXX)' EIGEN='$(EIGEN)' PYTHON='$(PYTHON)' sh .ci/packages

packages-%:
	@$(PACKAGES) --install 'make $*' $(NEEDS_$*) -- $(WANTS_$*)

deps:
	@$(PACKAGES) --install 'make deps' gcc g++ $(NEEDS_test) $(WANTS_test-all)

# Submakes, so that nothing is compiled before the packages are there.
run: packages-run
	@$(MAKE) --no-print-directory $(RUN)
	$(RUN) --scene $(SCENE) $(ARGS)

box2d: packages-box2d
	@$(MAKE) --no-print-directory $(BOX2D)
	$(BOX2D) $(ARGS)

# With Jolt, which no package of Debian has: JOLT is its folder, JOLT_LIBRARY its library, JOLT_FLAGS are as that was made.
jolt: $(BUILD)/libkiri.a
	@if [ ! -e '$(JOLT)/Jolt/Jolt.h' ] || [ ! -e '$(JOLT_LIBRARY)' ]; then \
	    echo 'jolt: JOLT= and JOLT_LIBRARY= name no Jolt, not tested'; exit 0; fi; \
	$(CXX) -std=c++17 -O2 -Wall -Wextra -Werror $(JOLT_FLAGS) -isystem '$(JOLT)' -Iinclude samples/jolt/main.cpp $< '$(JOLT_LIBRARY)' \
	    -pthread -o $(BUILD)/samples/kiri-jolt && $(BUILD)/samples/kiri-jolt

play: packages-play
	@$(MAKE) --no-print-directory $(PLAY)
	$(PLAY) $(if $(GAME),--game $(GAME)) $(ARGS)

view: packages-view
	@$(MAKE) --no-print-directory $(VIEW)
	$(VIEW) $(FILE)

# Each program that passes leaves a file in $(BUILD)/passed; the end says how many, and what was skipped and why.
test: packages-test
	@rm -rf $(BUILD)/passed && mkdir -p $(BUILD)/passed
	@{ $(MAKE) --no-print-directory -k all-tests; echo $$? > $(BUILD)/status; } 2>&1 | tee $(BUILD)/test.log; \
	grep -E 'not tested|no .* made$$' $(BUILD)/test.log | sed 's/^/skipped: /'; \
	grep ' FAILED$$' $(BUILD)/test.log | sed 's/^== /failed: /; s/ FAILED$$//'; \
	echo "$$(ls $(BUILD)/passed | wc -l) of $(words $(ALL_RUNS)) programs passed, $$(cat $(BUILD)/passed/* | awk '{ n += $$1 } END { print n + 0 }') tests ($(config))"; \
	rm -rf $(BUILD)/passed; exit $$(cat $(BUILD)/status)

test-all: packages-test-all
	@$(MAKE) --no-print-directory test

fuzz: packages-fuzz
	@$(MAKE) --no-print-directory config=fuzz CC=clang CXX=clang++ build/fuzz/tests/fuzz_$(FUZZ)
	@mkdir -p build/fuzz/$(FUZZ)
	build/fuzz/tests/fuzz_$(FUZZ) -max_total_time=$(or $(TIME),60) -max_len=700 -timeout=60 -rss_limit_mb=4096 \
	    -artifact_prefix=build/fuzz/$(FUZZ)- build/fuzz/$(FUZZ) tests/data/fuzz/$(FUZZ)

sweep: packages-bench
	@$(MAKE) --no-print-directory $(BUILD)/tests/sweep_saves
	$(BUILD)/tests/sweep_saves $(ARGS)

scarce: packages-bench
	@$(MAKE) --no-print-directory $(BUILD)/tests/test_scarce $(BUILD)/tests/test_refusals
	$(BUILD)/tests/test_scarce all
	$(BUILD)/tests/test_refusals all

long: packages-bench
	@$(MAKE) --no-print-directory $(addprefix $(BUILD)/tests/test_,long slicing meeting swipe toybox)
	$(BUILD)/tests/test_meeting 5000 1000
	$(BUILD)/tests/test_swipe 2000 1 SwipeStill
	$(BUILD)/tests/test_swipe 2000 1 SwipeSwaying
	$(BUILD)/tests/test_swipe 2000 1 SwipeBlown
	for kind in Swaying Blown; do $(BUILD)/tests/test_swipe 4 1 "Hold$$kind" 600 || exit 1; done
	$(BUILD)/tests/test_long all
	$(BUILD)/tests/test_slicing all
	$(BUILD)/tests/test_toybox all

page: $(BUILD)/libkiri.so
	@$(PYTHON) -c 'import cffi, numpy, shapely' 2>/dev/null || { echo "make page takes cffi, NumPy and Shapely"; exit 1; }
	@KIRI_LIBRARY=$< $(PYTHON) tests/page.py $(ARGS)

# gcc's analyzer, cppcheck and clang-tidy, those that are there; tests/analyze.txt has the findings that are no errors.
# JOBS=1: one file at a time.
ANALYZED := $(wildcard src/*/*.c)

analyze:
	@JOBS='$(JOBS)' sh tests/analyze.sh $(ANALYZED)

deps-analyze:
	@CC='$(CC)' sh .ci/packages --install 'make analyze' gcc cppcheck clang-tidy valgrind

# The input of fuzzers covers all calls.
valgrind: packages-bench
	@$(MAKE) --no-print-directory config=debug $(patsubst %,build/debug/tests/fuzz_%,$(FUZZERS))
	@set -e; for fuzzer in $(FUZZERS); do \
	    valgrind -q --error-exitcode=1 build/debug/tests/fuzz_$$fuzzer tests/data/fuzz/$$fuzzer | tail -n 1; done

tsan: packages-tsan
	@$(MAKE) --no-print-directory config=thread run-test_tasks run-test_readers

# Counts from runs of older objects would be refused, or added.
coverage: packages-test
	@mkdir -p build/coverage && find build/coverage -name '*.gcda' -delete
	@$(MAKE) --no-print-directory config=coverage $$(sh tests/coverage.sh)
	@sh tests/coverage.sh build/coverage 95

# Measures the numbers that documents quote: tests/data/figures.txt.
figures: packages-figures
	@$(MAKE) --no-print-directory $(addprefix $(BUILD)/tests/,bench_scenes bench_features bench_growth bench_bullet accuracy)
	@mkdir -p build/accuracy build/bench
	@$(BUILD)/tests/bench_bullet > build/bench/bullet.csv
	@for bench in scenes features growth; do $(BUILD)/tests/bench_$$bench || exit 1; done
	@$(BUILD)/tests/accuracy tests/data build/accuracy cantilever
	@$(PYTHON) tests/figures.py --measure

bench: packages-bench
	@$(MAKE) --no-print-directory $(BENCHES)
	@set -e; for bench in $(BENCHES); do $$bench; done

accuracy extremes: %: packages-%
	@$(MAKE) --no-print-directory $(BUILD)/tests/$@
	@mkdir -p build/$@
	$(BUILD)/tests/$@ $(if $(filter accuracy,$@),tests/data build/accuracy "$(CASE)")

trade: packages-trade
	@$(MAKE) --no-print-directory $(BUILD)/tests/trade_page
	@mkdir -p build/accuracy
	$(BUILD)/tests/trade_page build/accuracy
	@$(PYTHON) tests/plot_trade.py build/accuracy/trade.csv build/accuracy/trade.png

contact: packages-contact
	@$(MAKE) --no-print-directory $(BUILD)/tests/contact
	$(BUILD)/tests/contact "$(CASE)"

# Scenes in samples/README.md; and the shape functions of one, as in figure 2 of the paper.
GALLERY := bunny spiral kirigami patchwork vortex fallingguy rubber flat card crane shirt patch bag letter stamps weave can
FILMS := miura lantern poster
# Films of the games; the first one plays itself.
PLAY_FILM := --headless --size 640x480 --oversampling 3 --every 6
JOIN = $(PYTHON) samples/join.py samples/pictures/$(1).webp 60 10 build/gallery/$(1)/frame_*.png
CURTAIN_FILM := --game curtain --level 5 --demo --ticks 480
NET_FILM := --script samples/games/scripts/net_6.txt

gallery: packages-gallery trade
	@$(MAKE) --no-print-directory $(RUN) $(BOX2D) $(PLAY)
	@mkdir -p samples/pictures
	set -e; for scene in $(GALLERY); do \
	    $(RUN) --scene $$scene --size 800x600 --every 1000 --output build/gallery/$$scene; \
	    cp build/gallery/$$scene/contact_sheet.png samples/pictures/$$scene.png; done
	rm -rf $(FILMS:%=build/gallery/%)
	set -e; for scene in $(FILMS); do $(RUN) --scene $$scene --size 480x360 --every 6 --output build/gallery/$$scene; done
	$(RUN) --scene fallingguy --paper --weights all --size 800x600 --every 1000 --output build/gallery/weights
	cp build/gallery/weights/contact_sheet.png samples/pictures/weights.png
	$(PLAY) $(CURTAIN_FILM) $(PLAY_FILM) --pictures build/gallery/curtain
	$(PLAY) $(NET_FILM) $(PLAY_FILM) --pictures build/gallery/net
	set -e; $(foreach film,curtain net $(FILMS),$(call JOIN,$(film));)
	$(BOX2D) --size 800x600 --ticks 180 --every 30 --output build/gallery/box2d
	cp build/gallery/box2d/contact_sheet.png samples/pictures/box2d.png
	cp build/accuracy/trade.png samples/pictures/
	cp build/accuracy/trade.csv samples/manual/

# The samples in other engines, as their tests see them.
.PHONY: gallery-engines

gallery-engines: web-test babylon-test love-test pygame-test godot-test
	cp build/babylon_test/2_cut.png samples/pictures/babylon.png
	$(PYTHON) samples/join.py samples/pictures/web_cut.webp 82 1 build/web_test/3_pieces.png
	$(PYTHON) samples/join.py samples/pictures/web_snowflake.webp 82 1 build/web_test/5_snowflake.png
	$(PYTHON) samples/join.py samples/pictures/web_lantern.webp 82 1 build/web_test/6_lantern.png
	cp build/love/love_290.png samples/pictures/love.png
	cp build/pygame/pygame_195.png samples/pictures/pygame.png
	cp $(BUILD)/godot/godot4.png samples/pictures/godot.png

# One tick of a scene, for the guide: what the picture is called, the tick, and options of kiri-run.
MOMENT = $(RUN) --quiet --ticks $(2) --every $$(($(2) - 1)) --output build/guide/$(1) $(3) && \
    cp build/guide/$(1)/frame_0001.png samples/pictures/guide_$(1).png

guide: packages-guide
	@$(MAKE) --no-print-directory $(RUN)
	@mkdir -p samples/pictures
	$(call MOMENT,cells,120,--scene bunny --grid 24 --cells --size 600x600)
	$(call MOMENT,regions,120,--scene bunny --regions --links --size 600x600)
	$(call MOMENT,weights,120,--scene bunny --weights 4 --size 600x600)
	$(call MOMENT,pieces,262,--scene flat --regions --links)

# The programs of the manual, as a user compiles them; what they print is what it says. And with what takes pictures.
MANUAL = $(PYTHON) samples/manual/manual.py $(BUILD)/manual \
    '$(CC) -std=c99 -Wall -Wextra -Werror $(FLAGS_$(config)) -Iinclude -Isamples {source} $(IMPORT_OBJECTS) $(BUILD)/libkiri.a -lstdc++ -lm -o {program}'
MANUAL_PICTURES := $(patsubst %,$(BUILD)/samples/%.c.o,manual/picture draw) $(PICTURE_OBJECTS) $(BUILD)/libkiri.a

.PHONY: manual manual-programs manual-golden

manual: packages-manual
	@$(MAKE) --no-print-directory manual-programs $(MANUAL_PICTURES)
	@$(MANUAL) --pictures $(MANUAL_PICTURES) $(GL_LIBRARIES) -lpng -lz -lstdc++ -lm

manual-programs: $(BUILD)/libkiri.a $(IMPORT_OBJECTS)
	@$(MANUAL)

# After a change that moves what they print.
manual-golden: $(BUILD)/libkiri.a $(IMPORT_OBJECTS)
	@$(MANUAL) --write

# Each test program by itself, so that -j runs several at a time. What it printed is beside it, and shown when it fails.
# Those that take longest begin first: what is begun last keeps one processor, and the others wait.
TEST_RUNS := $(patsubst $(BUILD)/tests/%,run-%,$(TESTS))
LONG_RUNS := $(filter $(TEST_RUNS),$(addprefix run-test_,samples layout extremes games refusals update saves load promises estimate \
             sleep fold seen tear time parting joined net box2d part_budget blade piece seam scarce toybox swipe))

.PHONY: $(TEST_RUNS) run-tests coverage

run-tests: $(TEST_RUNS)

# What a run that passed prints: its name; in `make test` which of all it is; the last line of its log.
ALL_RUNS = $(TEST_RUNS) $(FUZZ_RUNS) run-sweep_saves
PASSED = echo "== $<"; if [ -d $(BUILD)/passed ]; then sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p' $<.log > $(BUILD)/passed/$(<F); \
    echo "$$(ls $(BUILD)/passed | wc -l) of $(words $(ALL_RUNS)): $$(tail -n 1 $<.log)"; else tail -n 1 $<.log; fi

$(TEST_RUNS): run-%: $(BUILD)/tests/%
	@if $< > $<.log 2>&1; then $(PASSED); else echo "== $< FAILED"; cat $<.log; exit 1; fi

# Input that fuzzers have found, and more at random.
FUZZ_RUNS := $(patsubst %,run-fuzz_%,$(FUZZERS))

.PHONY: $(FUZZ_RUNS)

$(FUZZ_RUNS): run-fuzz_%: $(BUILD)/tests/fuzz_%
	@if $< tests/data/fuzz/$* > $<.log 2>&1; then $(PASSED); \
	else echo "== $< FAILED"; tail -n 20 $<.log; exit 1; fi

# Of two worlds each 500th save; with sanitizers each 3000th.
.PHONY: run-sweep_saves

run-sweep_saves: $(BUILD)/tests/sweep_saves
	@if $< 34 36 1 $(if $(filter sanitize,$(config)),3000,500) > $<.log 2>&1; then $(PASSED); \
	else echo "== $< FAILED"; tail -n 20 $<.log; exit 1; fi

all-tests: run-sweep_saves $(LONG_RUNS) $(ONCE) $(if $(filter release,$(config)),$(LANGUAGE_CHECKS)) $(TEST_RUNS) $(FUZZ_RUNS) \
    $(RUN) $(BOX2D) $(PLAY) exports $(PYTHON_CHECK)
	@echo "all tests passed ($(config))"

# The input of fuzzers and the recordings have all calls; Python loads no sanitized library.
quick: $(FUZZ_RUNS) $(addprefix run-test_,api recordings world) exports $(PYTHON_CHECK)
	@echo "a few tests passed ($(config))"

python: $(BUILD)/libkiri.so
	@if ! $(PYTHON) -c 'import cffi' 2>/dev/null; then echo "python: no cffi, binding not tested"; exit 0; fi; \
	echo "== tests/test_python.py"; KIRI_LIBRARY=$< $(PYTHON) tests/test_python.py

bindings:
	@$(PYTHON) bindings/generator

# It is fresh, complete, and the compiler's layout of structs is that of the description; emcc's too where it is there.
described: $(BUILD)/libkiri.so
	@$(PYTHON) bindings/generator --check
	@CC='$(CC)' $(PYTHON) tests/test_description.py $<

builds: lib $(RUN)
	@sh tests/test_build.sh

exported: $(RUN) $(VIEW)
	@mkdir -p $(BUILD)/exported && $(PYTHON) tests/test_glb.py $(RUN) $(BUILD)/exported
	@$(RUN) --quiet --ticks 70 --every 0 --points --record $(BUILD)/exported/view.kiri > $(BUILD)/exported/log
	@sh tests/test_view.sh $(VIEW) $(BUILD)/exported/view.kiri

$(BUILD)/samples/kiri-run-egl: $(filter-out %/offscreen.c.o,$(SAMPLE_OBJECTS)) samples/offscreen.c $(BUILD)/libkiri.a
	@echo "  $@"
	@$(COMPILE_C) -Iinclude -DKIRI_EGL -c samples/offscreen.c -o $@.o
	@$(LINK) -o $@ $(filter %.c.o,$^) $@.o $(filter %.a,$^) -lEGL -lGL -lpng -lz -lm

renderers: $(RUN)
	@if [ $(RENDERER) = egl ] || ! $(CC) -E -include EGL/egl.h -x c /dev/null > /dev/null 2>&1; then \
	    echo "renderers: not OSMesa and EGL, not tested"; exit 0; fi; \
	$(MAKE) --no-print-directory $(BUILD)/samples/kiri-run-egl && mkdir -p $(BUILD)/renderers && \
	    $(PYTHON) tests/test_renderers.py $(RUN) $(BUILD)/samples/kiri-run-egl $(BUILD)/renderers

# The folders of src are floors: a file includes from its own and from lower ones, never from higher ones. Circles inside a
# folder are counted by the ratchet.
FLOORS := core mesh field solver motion view sheet world

floors:
	@upper="$(FLOORS)"; for floor in $(FLOORS); do \
	    upper=$${upper#* }; [ "$$floor" != "$$upper" ] || break; \
	    for up in $$upper; do ! grep -n "#include \"\.\./$$up/" src/$$floor/* || exit 1; done; \
	done
	@echo "src: includes go down the floors"

# Benchmarks and tables, which no test runs, still compile.
UNRUN := $(wildcard $(addprefix tests/,bench*.c accuracy*.c contact*.c trade*.c sweep*.c))

unrun:
	@for source in $(UNRUN); do \
	    $(COMPILE_C) -Iinclude -Isrc -Isamples -Itests -Wno-unused-parameter -MF /dev/null -fsyntax-only $$source || exit 1; done
	@echo "benchmarks: all compile"

# What the sources say of themselves, without a build.
limits: ratchet floors fields quotes

# Under two minutes on two processors, with the build.
CHECK_RUNS := $(addprefix run-test_,blade fold cut piece pair api drawing record image world)

.PHONY: run-check

check: packages-check
	@$(MAKE) --no-print-directory run-check

run-check: limits $(CHECK_RUNS)
	@echo "$(words $(CHECK_RUNS)) of $(words $(TEST_RUNS)) programs passed; make test runs all"

# Figures of the sources against tests/ratchet.txt: `$(PYTHON) tests/ratchet.py --lower` makes limits stricter.
ratchet:
	@$(PYTHON) tests/ratchet.py

# Documents quote the figures that were measured.
quotes:
	@$(PYTHON) tests/figures.py

# What is saved of a struct is what it has.
fields:
	@$(PYTHON) tests/fields.py

# The public header stands alone, in strict C99 and C++11; each inner header, in C++ without run-time types too.
headers:
	@$(CC) -x c -std=c99 -Wall -Wextra -pedantic-errors -Werror -fsyntax-only include/kiri/kiri.h
	@$(CXX) -x c++ -std=c++11 -Wall -Wextra -pedantic-errors -Werror -fsyntax-only include/kiri/kiri.h
	@for header in src/*/*.h; do \
	    $(CC) -x c -std=c99 -Wall -Wextra -Werror -fsyntax-only $$header && \
	    $(CXX) -x c++ -std=c++14 -fno-rtti -Wall -Wextra -Werror -fsyntax-only $$header || exit 1; \
	done; echo "headers: each stands alone, in C and C++"

# Puts files into one, with each header where it is first included.
SINGLE = awk 'function resolve(path) { while (sub(/[^\/]+\/\.\.\//, "", path)) {} return path } \
    function emit(path, line, folder) { folder = path; sub(/[^\/]*$$/, "", folder); \
        while ((getline line < path) > 0) { \
            if (line ~ /^\#include ".*kiri\/kiri\.h"/) print "\#include \"kiri.h\""; \
            else if (line ~ /^\#include "/) { split(line, part, "\""); part[2] = resolve(folder part[2]); \
                if (!(part[2] in seen)) { seen[part[2]] = 1; emit(part[2]) } } \
            else print line } close(path) } \
    BEGIN { for (i = 1; i < ARGC; ++i) emit(ARGV[i]) }'

# In one file clang takes inline functions of headers for functions that somebody forgot.
FOR_CLANG = printf '%s\n' '\#ifdef __clang__' '\#pragma clang diagnostic ignored "-Wunused-function"' '\#endif'

single:
	@mkdir -p build/single
	@cp include/kiri/kiri.h build/single/kiri.h
	@$(SINGLE) $(foreach floor,$(FLOORS),$(wildcard src/$(floor)/*.c)) > build/single/kiri.c
	@{ $(FOR_CLANG); $(SINGLE) $(wildcard src/*/*.cpp); } > build/single/kiri.cpp

# The example of the README, built from the single files.
example: packages-example
	@$(MAKE) --no-print-directory single
	@mkdir -p build/single/kiri && cp include/kiri/kiri.h build/single/kiri/kiri.h
	@sed -n '/^```c$$/,/^```$$/p' README.md | sed '/^```/d' > build/single/example.c
	@cd build/single && $(CC) -std=c99 -Wall -Werror -I. -c kiri.c example.c && \
	    $(CXX) -std=c++14 -fno-rtti -Wall -Werror -isystem "$(EIGEN)" -c kiri.cpp -o kiri_cpp.o && \
	    $(CXX) kiri.o example.o kiri_cpp.o -lm -o example && ./example

exports: $(BUILD)/libkiri.so
	@others=$$(nm -D --defined-only $< | awk '$$NF !~ /^kiri/ { print $$NF }'); \
	if [ -n "$$others" ]; then echo "$< exports more than kiri*:"; echo "$$others"; exit 1; fi; \
	echo "$< exports nothing but kiri*: $$(nm -D --defined-only $< | wc -l) functions"

lib: $(BUILD)/libkiri.a $(BUILD)/libkiri.so

# Written only when the text is another one. Before the first object it is seen whether compilers and Eigen are there.
$(BUILD)/compile.txt: FORCE
	$(shell mkdir -p $(@D))$(file >$@.new,$(COMPILE_TEXT))
	@if cmp -s $@.new $@; then rm $@.new; else $(PACKAGES) 'make lib' $(NEEDS_lib) && mv $@.new $@; fi

$(BUILD)/link.txt: FORCE
	$(shell mkdir -p $(@D))$(file >$@.new,$(LINK_TEXT))
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

ifeq ($(config),coverage)
$(LIBRARY_OBJECTS): private FLAGS += $(FLAGS_counted)
endif

# Their loops are in the library: a compiler takes half as long at -O1.
ifneq ($(config),debug)
$(TESTS:%=%.c.o): private FLAGS += -O1
endif

# The library is compiled for size, and its C without tables for backtraces. Ticks and cuts spend their time in the files
# of two lists; in those of the first one -O3 gains nothing.
ifeq ($(config),release)
$(LIBRARY_OBJECTS): private FLAGS += -Os -fno-asynchronous-unwind-tables
$(patsubst %,$(BUILD)/src/%.c.o,core/kiri_array core/kiri_vec mesh/kiri_mesh_build sheet/kiri_meeting \
    $(addprefix motion/kiri_,contact_row element energy plastic recoil solver step) solver/kiri_pattern view/kiri_sample world/kiri_pair): private FLAGS += -O2
$(patsubst %,$(BUILD)/src/%.o,mesh/kiri_square.c $(patsubst %,field/kiri_%.c,geodesic grid shape stencil) \
    $(patsubst %,motion/kiri_%.c,frame strain) $(patsubst %,sheet/kiri_%.c,seen touch) solver/kiri_matrix.cpp \
    $(patsubst %,view/kiri_%.c,bounds detail skin surface)): private FLAGS += -O3
endif

$(BUILD)/libkiri.a: $(LIBRARY_OBJECTS) $(TO_LINK)
	@rm -f $@
	@$(AR) rcs $@ $(LIBRARY_OBJECTS)

# The script hides the C++ templates too, which -fvisibility=hidden alone does not.
$(BUILD)/libkiri.so.$(VERSION): $(LIBRARY_OBJECTS) bindings/kiri.map $(TO_LINK)
	@echo "  $@"
	@$(LINK) -shared -Wl,-soname,libkiri.so.$(SOVERSION) -Wl,--version-script=bindings/kiri.map -o $@ $(LIBRARY_OBJECTS) -lm

# The links by which programs find it: when they are linked, and when they start.
$(BUILD)/libkiri.so: $(BUILD)/libkiri.so.$(VERSION)
	@ln -sf libkiri.so.$(VERSION) $(BUILD)/libkiri.so.$(SOVERSION)
	@ln -sf libkiri.so.$(SOVERSION) $@

$(BUILD)/src/%.c.o: src/%.c $(TO_COMPILE)
	@mkdir -p $(@D)
	@echo "  $<"
	@$(COMPILE_C) -fvisibility=hidden -c $< -o $@

$(BUILD)/src/%.cpp.o: src/%.cpp $(TO_COMPILE)
	@mkdir -p $(@D)
	@echo "  $<"
	@$(COMPILE_CXX) -fvisibility=hidden -fvisibility-inlines-hidden -isystem "$(EIGEN)" -c $< -o $@

$(BUILD)/samples/offscreen.c.o: private FLAGS += $(if $(filter egl,$(RENDERER)),-DKIRI_EGL)

$(BUILD)/samples/%.c.o: samples/%.c $(TO_COMPILE)
	@mkdir -p $(@D)
	@echo "  $<"
	@$(COMPILE_C) -Iinclude -c $< -o $@

$(BUILD)/samples/%.cpp.o: samples/%.cpp $(TO_COMPILE)
	@mkdir -p $(@D)
	@echo "  $<"
	@$(COMPILE_CXX) -Iinclude -c $< -o $@

$(BUILD)/tests/%.c.o: tests/%.c $(TO_COMPILE)
	@mkdir -p $(@D)
	@echo "  $<"
	@$(COMPILE_C) -Iinclude -Isrc -Isamples -Itests -Wno-unused-parameter -c $< -o $@

$(BUILD)/tests/%.cpp.o: tests/%.cpp $(TO_COMPILE)
	@mkdir -p $(@D)
	@echo "  $<"
	@$(COMPILE_CXX) -Iinclude -Isrc -Isamples -Itests -c $< -o $@

$(RUN): $(filter %.c.o,$(SAMPLE_OBJECTS)) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ $(GL_LIBRARIES) -lpng -lz -lm

$(BOX2D): $(BUILD)/samples/box2d/main.cpp.o $(ADAPTER_OBJECTS) $(PICTURE_OBJECTS) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lbox2d $(GL_LIBRARIES) -lpng -lz -lm

$(VIEW): $(addprefix $(BUILD)/samples/,view/main.c.o games/window.c.o games/sound.c.o games/canvas_text.c.o) \
        $(filter-out %/run.c.o,$(filter %.c.o,$(SAMPLE_OBJECTS))) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lSDL2_ttf -lSDL2 $(GL_LIBRARIES) -lpng -lz -lm

$(PLAY): $(GAME_OBJECTS) $(ADAPTER_OBJECTS) $(PICTURE_OBJECTS) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lSDL2_ttf -lSDL2 -lbox2d $(GL_LIBRARIES) -lpng -lz -lm

$(BUILD)/tests/accuracy: $(patsubst %,$(BUILD)/%.c.o,tests/accuracy $(ACCURACY_PARTS)) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lm

$(BUILD)/tests/trade_page: $(patsubst %,$(BUILD)/tests/%.c.o,trade_page trade_drape springs specimen frame_layout) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lm

$(BUILD)/tests/contact: $(patsubst %,$(BUILD)/%.c.o,tests/contact $(CONTACT_PARTS)) $(BUILD)/tests/contact_box2d.cpp.o \
        $(BOX2D_LAWS) $(SCENE_OBJECTS) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lbox2d -lm

$(BUILD)/tests/extremes: $(BUILD)/tests/extremes_main.c.o $(BUILD)/tests/extremes.c.o $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lm

$(TESTS): $(BUILD)/tests/main.c.o

$(BUILD)/tests/test_box2d: $(BUILD)/tests/test_box2d.cpp.o $(BOX2D_LAWS) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lcmocka -lbox2d -lm

$(BUILD)/tests/bench_bullet.cpp.o: override CXXFLAGS += -isystem /usr/include/bullet
$(BUILD)/tests/bench_bullet: $(BUILD)/tests/bench_bullet.cpp.o $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lBulletSoftBody -lBulletDynamics -lBulletCollision -lLinearMath -lm

$(BUILD)/tests/test_net: $(BUILD)/tests/test_net.cpp.o $(GAME_PARTS) $(ADAPTER_OBJECTS) $(PICTURE_OBJECTS) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $^ -lcmocka -lSDL2_ttf -lSDL2 -lbox2d $(GL_LIBRARIES) -lpng -lz -lm

$(addprefix $(BUILD)/tests/test_,api callbacks lifetimes readers record refusals): $(BUILD)/tests/every_call.c.o

$(BUILD)/tests/test_extremes: $(BUILD)/tests/extremes.c.o

$(BUILD)/tests/test_quality: $(BUILD)/tests/sweep.c.o

$(BUILD)/tests/test_record: $(patsubst %,$(BUILD)/tests/%.c.o,storm_acts storm_cuts storm_seen)

$(BUILD)/tests/eigen_solvers.cpp.o: override CXXFLAGS += -isystem "$(EIGEN)"
$(BUILD)/tests/bench_solvers: $(BUILD)/tests/eigen_solvers.cpp.o

$(BUILD)/tests/%: $(BUILD)/tests/%.c.o $(VALIDATE_OBJECTS) $(SCENE_OBJECTS) $(BUILD)/libkiri.a
	@echo "  $@"
	@$(LINK) -o $@ $(filter-out %.a,$^) $(filter %.a,$^) -lcmocka $(TEST_LIBRARIES) -lm

$(BUILD)/tests/test_drawing: $(IMPORT_OBJECTS)
$(BUILD)/tests/test_fold: $(IMPORT_OBJECTS) $(BUILD)/samples/creases.c.o

$(BUILD)/tests/test_image: $(BUILD)/samples/image.c.o
$(BUILD)/tests/test_image: TEST_LIBRARIES := -lpng -lz

$(BUILD)/tests/test_games: $(GAME_PARTS) $(ADAPTER_OBJECTS) $(PICTURE_OBJECTS)
$(BUILD)/tests/test_games: TEST_LIBRARIES = $(BUILD)/libkiri.a -lSDL2_ttf -lSDL2 -lbox2d $(GL_LIBRARIES) -lpng -lz

# Threads read a world, or work on its ticks.
$(BUILD)/tests/test_readers $(BUILD)/tests/test_tasks $(BUILD)/tests/bench_tasks: override LDFLAGS += -pthread

$(addprefix $(BUILD)/tests/,test_saves test_waiting): \
    $(patsubst %,$(BUILD)/tests/%.c.o,storm_types storm_acts storm_cuts storm_seen)

$(BUILD)/tests/test_saves: $(patsubst %,$(BUILD)/tests/%.c.o,fuzz fuzz_saved)

# Fuzzers: with the main of libFuzzer, or one that runs what it is given.
FUZZ_MAIN := $(if $(filter fuzz,$(config)),,$(BUILD)/tests/fuzz_main.c.o)

$(patsubst %,$(BUILD)/tests/fuzz_%,$(FUZZERS)): $(BUILD)/tests/fuzz.c.o $(FUZZ_MAIN)
$(BUILD)/tests/fuzz_calls: $(patsubst %,$(BUILD)/tests/fuzz_%.c.o,read world)
$(BUILD)/tests/fuzz_load $(BUILD)/tests/fuzz_spoil $(BUILD)/tests/sweep_saves: \
    $(patsubst %,$(BUILD)/tests/%.c.o,fuzz_saved storm_types storm_acts storm_cuts storm_seen)
$(BUILD)/tests/fuzz_spoil $(BUILD)/tests/sweep_saves: $(patsubst %,$(BUILD)/tests/fuzz_%.c.o,traced archive)
$(BUILD)/tests/sweep_saves: $(BUILD)/tests/fuzz.c.o
ifeq ($(config),fuzz)
$(BUILD)/tests/fuzz_%: override LDFLAGS += -fsanitize=fuzzer
endif

# Tests that compare with the heavy elastica.
$(BUILD)/tests/test_estimate $(BUILD)/tests/test_layout: $(BUILD)/tests/reference.c.o

# ---- The same bits everywhere ----

# What prints the hashes, what makes the calls of a recording, and what solves linear systems, without other libraries. They are linked from objects,
# for archives differ between machines.
STORM ?= $(BUILD)/tests/storm
REPLAY ?= $(BUILD)/tests/replay
MATRIX ?= $(BUILD)/tests/matrix

$(STORM): $(patsubst %,$(BUILD)/tests/%.c.o,storm storm_types storm_acts storm_cuts storm_seen)
$(REPLAY): $(BUILD)/tests/replay_hash.c.o
$(MATRIX): $(BUILD)/tests/matrix_hash.c.o
$(STORM) $(REPLAY) $(MATRIX): $(LIBRARY_OBJECTS) $(TO_LINK)
	@echo "  $@"
	@$(LINK) -o $@ $(filter %.o,$^) $(STORM_LIBRARIES) -lm

# What the sources refuse, as far as the compiler knows it.
float-guards:
	@for option in -ffast-math -Ofast -ffinite-math-only -mfpmath=387; do \
	    echo | $(CC) $$option -fsyntax-only -x c - 2> /dev/null || continue; \
	    $(CC) $$option -fsyntax-only -x c src/core/kiri_float.h 2>&1 | grep -q '#error .*Kiri' || \
	        { echo "kiri_float.h compiles with $$option"; exit 1; }; \
	done; echo "floats: options that give other bits do not compile"

# TARGETS='aarch64 wasm': these only; TIME=300: begins no target after so many seconds. Its makes share the jobs of this
# one, so it is called with make -n too, and is only shown then.
portable: float-guards packages-portable
	+@$(if $(findstring n,$(filter-out --%,$(firstword -$(MAKEFLAGS)))),echo) env MAKE='$(MAKE)' TARGETS='$(TARGETS)' TIME='$(TIME)' sh tests/portable.sh

# After a change that moves state hashes, and says why.
portable-golden: $(STORM)
	$(STORM) > tests/data/storm.txt

# The same: the calls of recorded games, with what comes of them now.
recordings: $(BUILD)/tests/test_recordings
	$< --write

PORTABLE_PACKAGES := clang lld g++-i686-linux-gnu g++-aarch64-linux-gnu g++-arm-linux-gnueabihf g++-riscv64-linux-gnu \
                     g++-s390x-linux-gnu qemu-user g++-mingw-w64-x86-64 wine wine64 emscripten nodejs musl-tools

deps-portable:
	@sudo=; if [ "$$(id -u)" != 0 ]; then sudo=sudo; fi; \
	$$sudo apt-get update && $$sudo env DEBIAN_FRONTEND=noninteractive apt-get -y --no-install-recommends install \
	    gcc g++ make libeigen3-dev $(PORTABLE_PACKAGES) || { echo "make portable takes $(PORTABLE_PACKAGES)"; exit 1; }

.PHONY: float-guards portable portable-golden recordings deps-portable

format:
	clang-format -i $(wildcard include/kiri/*.h src/*/*.h src/*/*.c src/*/*.cpp samples/*.h samples/*.c samples/*.cpp samples/*/*.h samples/*/*.c samples/*/*.cpp tests/*.h tests/*.c tests/*.cpp)

.PHONY: help

help:
	@sed -n '2,/^$$/s/^# \{0,1\}//p' Makefile

clean:
	rm -rf build

-include $(wildcard $(BUILD)/*/*.d $(BUILD)/*/*/*.d)
