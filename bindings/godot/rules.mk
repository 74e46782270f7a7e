# make godot tests the classes in Godot 3 and 4, where these are; godot-test plays a cut in both under Xvfb, and looks at the
# pictures; godot-play and godot4-play open the projects; package-godot makes addons; deps-godot4 gets Godot 4 of Debian sid.

LANGUAGE_CHECKS += godot
WANTS_test-all += godot3 xvfb xauth

.PHONY: godot godot-test godot-play godot4-play bench-godot package-godot deps-godot4

GODOT3 ?= godot3
GODOT4 ?= $(firstword $(wildcard $(CURDIR)/build/godot4/godot4) godot4)
GODOT := $(BUILD)/godot
GODOT_COMMON := $(patsubst %,$(GODOT)/%.o,tables values call objects by_hand)
GODOT_DOCUMENTS := $(wildcard bindings/godot/doc_classes/*.xml)

$(GODOT)/%.o: bindings/godot/%.c $(TO_COMPILE)
	@mkdir -p $(@D)
	@$(COMPILE_C) -Iinclude -fvisibility=hidden -c $< -o $@

# The documents as texts of C, for the editor of Godot 4.
$(GODOT)/documents.o: $(GODOT_DOCUMENTS) $(TO_COMPILE)
	@mkdir -p $(@D)
	@{ echo 'extern const char* const DOCUMENTS[];'; echo 'const char* const DOCUMENTS[] = {'; \
	    for file in $(GODOT_DOCUMENTS); do sed 's/\\/\\\\/g; s/"/\\"/g; s/.*/"&\\n"/' $$file; echo ','; done; echo '0 };'; } \
	    > $(GODOT)/documents.c
	@$(COMPILE_C) -Wno-overlength-strings -fvisibility=hidden -c $(GODOT)/documents.c -o $@

$(GODOT)/libkiri_godot3.so: $(GODOT_COMMON) $(GODOT)/host3.o $(BUILD)/libkiri.a
	@$(LINK) -shared -o $@ $^ -lm

$(GODOT)/libkiri_godot4.so: $(GODOT_COMMON) $(GODOT)/host4.o $(GODOT)/documents.o $(BUILD)/libkiri.a
	@$(LINK) -shared -o $@ $^ -lm

-include $(wildcard $(GODOT)/*.d)

GODOT_LIBRARIES := $(GODOT)/libkiri_godot3.so $(GODOT)/libkiri_godot4.so
GODOT_TEST = $(PYTHON) tests/test_godot.py --build $(GODOT) --godot3 '$(GODOT3)' --godot4 '$(GODOT4)'

godot: $(GODOT_LIBRARIES) $(BUILD)/tests/twin
	@$(GODOT_TEST) classes --twin $(BUILD)/tests/twin

godot-test: $(GODOT_LIBRARIES)
	@$(GODOT_TEST) pictures

# What calls cost.
bench-godot: $(GODOT_LIBRARIES)
	@$(GODOT_TEST) bench

# Zips of addons/kiri; the first program and the example run with what is in them, in an empty project.
package-godot: $(GODOT_LIBRARIES)
	@$(GODOT_TEST) packages --version $(VERSION)

godot-play: $(GODOT_LIBRARIES)
	@$(GODOT_TEST) project3 && $(GODOT3) --path $(GODOT)/project3

godot4-play: $(GODOT_LIBRARIES)
	@$(GODOT_TEST) project4 && $(GODOT4) --path $(GODOT)/project4

deps-godot4:
	@sh bindings/godot/get_godot4.sh build/godot4
