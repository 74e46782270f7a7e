# make rust tests the crates kiri-sys and kiri; rust-cost says what calls cost; package-rust makes packages and uses them.
#
# Crates are fetched once, by the first of these.

LANGUAGE_CHECKS += rust

.PHONY: rust rust-cost package-rust

CARGO ?= cargo
RUST_TARGET := $(CURDIR)/build/rust
# Of the library that is built already.
RUST_ENV = KIRI_LIBRARY_DIR='$(CURDIR)/$(BUILD)' CARGO_TARGET_DIR='$(RUST_TARGET)' CARGO_TERM_COLOR=never
RUST_IS_THERE = [ "$$(printf '%s\n' 1.82 "$$($(CARGO) --version 2> /dev/null | cut -d ' ' -f 2)" | sort -V | head -n 1)" = 1.82 ]
RUST_CARGO = cd bindings/rust && $(RUST_ENV) $(CARGO)

# As the documentation site makes it: without the library and without Eigen; each public item has a comment.
RUST_DOCS = cd bindings/rust && DOCS_RS=1 EIGEN_DIR=/none CARGO_TARGET_DIR='$(RUST_TARGET)/docs' RUSTDOCFLAGS='-D warnings' \
    $(CARGO) doc --offline --locked --quiet --no-deps

rust: $(BUILD)/libkiri.a $(BUILD)/tests/twin
	@if ! $(RUST_IS_THERE); then echo "rust: no cargo of 1.82 or later, binding not tested"; exit 0; fi; \
	mkdir -p $(RUST_TARGET); log=$(RUST_TARGET)/log; \
	if ! (cd bindings/rust && { $(CARGO) fetch --locked --offline || $(CARGO) fetch --locked; }) > $$log 2>&1; then \
	    echo "rust: the crate cc cannot be fetched, binding not tested"; exit 0; fi; \
	echo "== bindings/rust"; \
	($(RUST_CARGO) test --offline --locked --quiet) > $$log 2>&1 || { cat $$log; exit 1; }; \
	if $(CARGO) clippy --version > /dev/null 2>&1; then \
	    ($(RUST_CARGO) clippy --offline --locked --quiet --all-targets -- -D warnings) > $$log 2>&1 || { cat $$log; exit 1; }; fi; \
	($(RUST_DOCS)) > $$log 2>&1 || { cat $$log; exit 1; }; \
	for example in first_cut twin; do ($(RUST_CARGO) build --offline --locked --quiet --example $$example) || exit 1; done; \
	$(RUST_TARGET)/debug/examples/first_cut | grep -qx '2 pieces' || { echo "rust: the first cut gives no 2 pieces"; exit 1; }; \
	$(RUST_TARGET)/debug/examples/twin > $(RUST_TARGET)/twin.txt; $(BUILD)/tests/twin | head -n 2 | cmp - $(RUST_TARGET)/twin.txt || exit 1; \
	echo "rust: tests pass, and the hash is that of C: $$(head -n 1 $(RUST_TARGET)/twin.txt)"

rust-cost: $(BUILD)/libkiri.a
	@$(RUST_CARGO) run --quiet --locked --release --example cost

# ---- samples/macroquad: a window; and a picture of a cut that plays itself, where there is no screen ----

MACROQUAD = cd samples/macroquad && $(RUST_ENV) $(CARGO)
MACROQUAD_RUN := $(RUST_TARGET)/debug/kiri-macroquad

.PHONY: macroquad macroquad-test

macroquad: $(BUILD)/libkiri.a
	@$(MACROQUAD) run --quiet

# The picture has the sheet, of which a part has come off; without a screen or OpenGL nothing is tested.
macroquad-test: $(BUILD)/libkiri.a
	@if ! $(RUST_IS_THERE) || ! command -v xvfb-run > /dev/null; then echo "macroquad: no cargo or no Xvfb, not tested"; exit 0; fi; \
	set -e; ($(MACROQUAD) build --quiet --locked); \
	LIBGL_ALWAYS_SOFTWARE=1 timeout 120 xvfb-run -a -s '-screen 0 800x600x24' $(MACROQUAD_RUN) --script $(RUST_TARGET)/macroquad.png > $(RUST_TARGET)/macroquad.txt; \
	grep -q '^2 sheets' $(RUST_TARGET)/macroquad.txt; $(PYTHON) samples/check_paper.py build/rust/macroquad.png; \
	echo "macroquad: $$(cat $(RUST_TARGET)/macroquad.txt); the picture is $(RUST_TARGET)/macroquad.png"

# ---- Packages: both crates, with the library's sources as single files; built and used where nothing else is ----

RUST_STAGE := $(RUST_TARGET)/stage
RUST_CLEAN := $(RUST_TARGET)/clean

package-rust: single
	@set -e; rm -rf $(RUST_STAGE) $(RUST_CLEAN); mkdir -p $(RUST_STAGE) $(RUST_CLEAN)/src; \
	cp -r bindings/rust/Cargo.* bindings/rust/kiri-sys bindings/rust/kiri $(RUST_STAGE); cp LICENSE $(RUST_STAGE)/kiri; \
	cp LICENSE $(RUST_STAGE)/kiri-sys; \
	mkdir $(RUST_STAGE)/kiri-sys/library; cp build/single/kiri.h build/single/kiri.c build/single/kiri.cpp $(RUST_STAGE)/kiri-sys/library; \
	cd $(RUST_STAGE); $(CARGO) package --workspace --no-verify --allow-dirty --quiet --target-dir $(RUST_TARGET); \
	cd $(RUST_CLEAN); for crate in kiri-sys kiri-sheets; do tar xzf $(RUST_TARGET)/package/$$crate-$(VERSION).crate; done; \
	printf '[package]\nname = "clean"\nversion = "0.0.0"\nedition = "2021"\n[workspace]\n[dependencies]\nkiri-sheets = { path = "kiri-sheets-%s" }\n[patch.crates-io]\nkiri-sys = { path = "kiri-sys-%s" }\n' $(VERSION) $(VERSION) > Cargo.toml; \
	cp kiri-sheets-$(VERSION)/examples/first_cut.rs src/main.rs; \
	env -u KIRI_LIBRARY_DIR EIGEN_DIR='$(EIGEN)' $(CARGO) run --quiet --target-dir $(RUST_CLEAN)/target | grep -qx '2 pieces'; \
	echo "rust: $(RUST_TARGET)/package: kiri-sys-$(VERSION).crate ($$(wc -c < $(RUST_TARGET)/package/kiri-sys-$(VERSION).crate) bytes) and kiri-sheets-$(VERSION).crate, and a program of the two cuts"
