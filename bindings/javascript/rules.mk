# The library as WebAssembly, its JavaScript, and the page in samples/web.
#
#   make wasm                build/wasm/kiri.wasm
#   make javascript          the binding's tests, under node
#   make package-javascript  the npm package, and a test that installs it
#   make web                 the page, static files in build/web; web-serve; web-test; web-film: the film of the README
#   make babylon             a host in babylon.js, static files in build/babylon; babylon-serve; babylon-test

WASM := build/wasm
EMCC ?= emcc
EMXX ?= em++
NEEDS_web := $(NEEDS_lib) emscripten nodejs npm python3
NEEDS_package-javascript := $(NEEDS_web)
NEEDS_babylon := $(NEEDS_web)
WANTS_web-test := $(NEEDS_web) chromium
# Small functions within others make less code, not more: without -finline-functions it grows.
WASM_HOT ?= -Os -finline-functions
WASM_COLD ?= -Oz -finline-functions
WASM_LTO ?= -flto
WASM_FLAGS := $(WASM_LTO) -mbulk-memory -mnontrapping-fptoint -msign-ext -DNDEBUG -fno-math-errno -ffp-contract=off -fvisibility=hidden -Wall -Wextra
WASM_LINK := --no-entry -sSTANDALONE_WASM -sERROR_ON_UNDEFINED_SYMBOLS=0 -sWARN_ON_UNDEFINED_SYMBOLS=0 -sALLOW_MEMORY_GROWTH -sWASM_BIGINT -sMALLOC=emmalloc \
             -sTOTAL_STACK=524288 -sINITIAL_MEMORY=8MB -sMAXIMUM_MEMORY=2GB
WASM_OBJECTS := $(patsubst %,$(WASM)/%.o,$(wildcard src/*/*.c src/*/*.cpp) bindings/javascript/hooks.c)

# What ticks spend their time in is compiled for speed, within reason; all else for size.
WASM_HOT_SOURCES := $(addsuffix .c, \
    $(addprefix src/motion/kiri_,contact_row element frame solver step strain) $(addprefix src/view/kiri_,sample skin surface) \
    $(addprefix src/field/kiri_,geodesic path shape stencil) $(addprefix src/sheet/kiri_,meeting touch) src/solver/kiri_pattern)

.PHONY: wasm

wasm: $(WASM)/kiri.wasm

# What was compiled with other options is compiled again.
$(WASM_OBJECTS): bindings/javascript/rules.mk
$(WASM_OBJECTS): WASM_SIZE = $(WASM_COLD)
$(WASM_HOT_SOURCES:%=$(WASM)/%.o) $(WASM)/src/solver/kiri_matrix.cpp.o: WASM_SIZE = $(WASM_HOT)

$(WASM)/%.c.o: %.c
	@mkdir -p $(@D)
	@echo "  wasm $<"
	@$(EMCC) -std=c99 $(WASM_SIZE) $(WASM_FLAGS) -Iinclude -MMD -MP -c $< -o $@

$(WASM)/%.cpp.o: %.cpp
	@mkdir -p $(@D)
	@echo "  wasm $<"
	@$(EMXX) -std=c++14 $(WASM_SIZE) $(WASM_FLAGS) -fno-rtti -isystem "$(EIGEN)" -MMD -MP -c $< -o $@

# All functions of the header, and what runtime.js calls beside them.
$(WASM)/exports.txt: bindings/kiri.json bindings/javascript/rules.mk
	@mkdir -p $(@D)
	@$(PYTHON) -c 'import json; print(*["_" + f["name"] for f in json.load(open("$<"))["functions"]], \
	    "_kiriHost_SetHooks", "_kiriHost_SetDraw", "_malloc", "_free", sep="\n")' > $@

$(WASM)/kiri.wasm: $(WASM_OBJECTS) $(WASM)/exports.txt
	@$(EMXX) -Os $(WASM_LTO) $(WASM_LINK) -sEXPORTED_FUNCTIONS=@$(WASM)/exports.txt $(WASM_OBJECTS) -o $@
	@echo "  $@: $$(wc -c < $@) bytes, $$(gzip -9c $@ | wc -c) as gzip"

-include $(WASM_OBJECTS:.o=.d)

# As a user has it: kiri.js and what it stands on beside kiri.wasm.
WASM_PACKAGE := $(WASM)/kiri

$(WASM_PACKAGE)/kiri.wasm: $(WASM)/kiri.wasm bindings/javascript/kiri.js bindings/javascript/kiri.d.ts \
        bindings/javascript/runtime.js bindings/javascript/package.json bindings/javascript/README.md LICENSE
	@mkdir -p $(@D)
	@cp $^ $(@D)

LANGUAGE_CHECKS += javascript

.PHONY: javascript javascript-tests

# What the submake shares with other targets is there before: two makes at a time must not make the same file.
javascript: $(BUILD)/tests/twin
	@if ! command -v $(EMXX) > /dev/null || ! command -v node > /dev/null; then \
	    echo "javascript: no $(EMXX) or node, binding not tested"; \
	else $(MAKE) --no-print-directory javascript-tests; fi

javascript-tests: $(WASM_PACKAGE)/kiri.wasm $(BUILD)/tests/twin
	@echo "== tests/test_javascript.mjs"
	@node --expose-gc tests/test_javascript.mjs $(WASM_PACKAGE) "$$($(BUILD)/tests/twin | sed -n 's/hash //p')" \
	    > $(WASM)/test.log 2>&1 || { cat $(WASM)/test.log; exit 1; }
	@grep -h 'garbage of a tick\|^# pass' $(WASM)/test.log

# ---- The page: static files in build/web ----

WEB := build/web
WEB_TOOLS := build/web_tools

.PHONY: web web-serve web-test

# A submake, so that nothing is compiled before the packages are there.
web: packages-web
	@$(MAKE) --no-print-directory $(WEB)/main.js

$(WEB_TOOLS)/installed: samples/web/package.json
	@mkdir -p $(@D) && cp $< $(@D)
	@npm install --prefix $(@D) --ignore-scripts --no-audit --no-fund --silent
	@touch $@

# Drawings to cut, for the page.
IMPORT_CALLS := _readDrawing,_joinDrawing,_getText,_getStyles,_getLines,_getPoints,_getNumber,_malloc,_free
IMPORT_SOURCES := $(wildcard samples/import*.c) samples/web/import_web.c

$(WASM)/import.wasm: $(IMPORT_SOURCES) $(wildcard samples/import*.h) bindings/javascript/rules.mk
	@mkdir -p $(@D)
	@$(EMCC) -std=c99 -Os -flto -Wall -Wextra -DNDEBUG --no-entry -sSTANDALONE_WASM -sALLOW_MEMORY_GROWTH -sMALLOC=emmalloc \
	    -sTOTAL_STACK=262144 -sINITIAL_MEMORY=1MB -sEXPORTED_FUNCTIONS=$(IMPORT_CALLS) $(IMPORT_SOURCES) -o $@
	@echo "  $@: $$(wc -c < $@) bytes, $$(gzip -9c $@ | wc -c) as gzip"

$(WEB)/main.js: $(filter-out %.md %.c %/film.mjs,$(wildcard samples/web/*)) $(WASM_PACKAGE)/kiri.wasm $(WASM)/import.wasm $(WEB_TOOLS)/installed
	@mkdir -p $(@D)
	@cp samples/web/*.html samples/web/*.css $(WASM_PACKAGE)/kiri.wasm $(WASM)/import.wasm $(@D)
	@NODE_PATH=$(WEB_TOOLS)/node_modules $(WEB_TOOLS)/node_modules/.bin/esbuild samples/web/main.js --bundle --minify \
	    --format=esm --target=es2022 --alias:kiri=./$(WASM_PACKAGE)/kiri.js --outfile=$@ --log-level=warning
	@echo "  $(WEB): $$(cat $(WEB)/* | wc -c) bytes"

# Any server of static files does.
web-serve: web
	cd $(WEB) && $(PYTHON) -m http.server 8000

BROWSER ?= $(firstword $(wildcard /usr/bin/chromium /usr/bin/chromium-browser /usr/bin/google-chrome))

# The recording of the page ends in the same state here.
web-test: web $(BUILD)/tests/replay_hash
	@if [ -z "$(BROWSER)" ]; then echo "web: no chromium, the page was not tested"; \
	else for test in web web_features web_first; do \
	        node tests/test_$$test.mjs $(WEB) $(WEB_TOOLS)/node_modules/playwright-core/index.js $(WEB)_test $(BROWSER) || exit 1; done; \
	    test "$$($(BUILD)/tests/replay_hash $(WEB)_test/recording)" = "$$(cat $(WEB)_test/hash)" && \
	    echo "web: C ends in the same state"; fi

# The moving picture of the README.
NEEDS_web-film := $(NEEDS_web) chromium python3-pil
FILM_PICTURES := build/web_film

.PHONY: web-film

web-film: packages-web-film
	@$(MAKE) --no-print-directory $(WEB)/main.js
	@rm -rf $(FILM_PICTURES)
	@node samples/web/film.mjs $(WEB) $(WEB_TOOLS)/node_modules/playwright-core/index.js $(FILM_PICTURES) $(BROWSER)
	@$(PYTHON) samples/join.py samples/pictures/film.webp 55 15 $(FILM_PICTURES)/film_*.png

# ---- The host in babylon.js: static files in build/babylon ----

BABYLON := build/babylon
BABYLON_TOOLS := build/babylon_tools

.PHONY: babylon babylon-serve babylon-test

babylon: packages-babylon
	@$(MAKE) --no-print-directory $(BABYLON)/main.js

$(BABYLON_TOOLS)/installed: samples/babylon/package.json
	@mkdir -p $(@D) && cp $< $(@D)
	@npm install --prefix $(@D) --ignore-scripts --no-audit --no-fund --silent
	@touch $@

$(BABYLON)/main.js: $(wildcard samples/babylon/*) $(WASM_PACKAGE)/kiri.wasm $(WEB_TOOLS)/installed $(BABYLON_TOOLS)/installed
	@mkdir -p $(@D)
	@cp samples/babylon/index.html $(WASM_PACKAGE)/kiri.wasm $(@D)
	@NODE_PATH=$(BABYLON_TOOLS)/node_modules $(WEB_TOOLS)/node_modules/.bin/esbuild samples/babylon/main.js --bundle --minify \
	    --format=esm --target=es2022 --alias:kiri=./$(WASM_PACKAGE)/kiri.js --outfile=$@ --log-level=warning

babylon-serve: babylon
	cd $(BABYLON) && $(PYTHON) -m http.server 8000

babylon-test: babylon
	@if [ -z "$(BROWSER)" ]; then echo "babylon: no chromium, the page was not tested"; \
	else node tests/test_babylon.mjs $(BABYLON) $(WEB_TOOLS)/node_modules/playwright-core/index.js $(BABYLON)_test $(BROWSER); fi

# The npm package, installed in an empty folder and used there.
.PHONY: package-javascript

package-javascript: packages-package-javascript
	@$(MAKE) --no-print-directory $(WASM_PACKAGE)/kiri.wasm
	@cd $(WASM_PACKAGE) && npm pkg set version=$(VERSION) --silent && npm pack --silent --pack-destination .. > /dev/null
	@rm -rf $(WASM)/clean && mkdir $(WASM)/clean && cp tests/first_cut.mjs tests/first_cut.cjs $(WASM)/clean
	@cd $(WASM)/clean && npm init -y > /dev/null 2>&1 && npm install --no-audit --no-fund --silent ../kiri-$(VERSION).tgz && \
	    node first_cut.mjs | grep '^2 pieces'
	@if node -e 'process.exit(process.features.require_module ? 0 : 1)'; then cd $(WASM)/clean && node first_cut.cjs | grep '^2 pieces'; \
	else echo "package-javascript: node before 20.19, CommonJS not tested"; fi
	@$(MAKE) --no-print-directory $(WEB_TOOLS)/installed
	@$(WEB_TOOLS)/node_modules/.bin/publint --strict $(WASM_PACKAGE)
	@{ sed 's/^const world = /using world = /' tests/first_cut.mjs; } > $(WASM)/clean/first_cut.mts
	@cd $(WASM)/clean && ../../web_tools/node_modules/.bin/tsc --noEmit --strict --target es2022 --module nodenext first_cut.mts && \
	    echo "  TypeScript takes the declarations, and using world = new World()"
	@echo "  $(WASM)/kiri-$(VERSION).tgz: $$(wc -c < $(WASM)/kiri-$(VERSION).tgz) bytes"
