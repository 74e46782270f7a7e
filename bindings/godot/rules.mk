# make godot opens samples/godot in Godot 3; godot-test plays a cut under Xvfb, and looks at the picture.

.PHONY: godot godot-test godot-picture

GODOT ?= godot3
GODOT_PROJECT := build/godot
GODOT_TAKES := bindings/godot/kiri_godot.c bindings/godot/godot.h $(wildcard samples/godot/*)

# The project, with the native library in it.
$(GODOT_PROJECT)/bin/libkiri_godot.so: $(GODOT_TAKES) $(BUILD)/libkiri.a
	@mkdir -p $(@D)
	@cp samples/godot/* $(GODOT_PROJECT)
	@$(COMPILE_C) -Iinclude -fvisibility=hidden -c bindings/godot/kiri_godot.c -o $(GODOT_PROJECT)/kiri_godot.o
	@$(LINK) -shared -o $@ $(GODOT_PROJECT)/kiri_godot.o $(BUILD)/libkiri.a -lm

godot: $(GODOT_PROJECT)/bin/libkiri_godot.so
	@$(GODOT) --path $(GODOT_PROJECT)

godot-test: $(BUILD)/libkiri.a
	@if ! command -v $(GODOT) > /dev/null || ! command -v xvfb-run > /dev/null; then echo "godot: no $(GODOT) or no Xvfb, not tested"; \
	else $(MAKE) --no-print-directory godot-picture; fi

godot-picture: $(GODOT_PROJECT)/bin/libkiri_godot.so
	@set -e; rm -f $(GODOT_PROJECT)/godot.png; \
	LIBGL_ALWAYS_SOFTWARE=1 timeout 60 xvfb-run -a -s '-screen 0 800x600x24' $(GODOT) --path $(GODOT_PROJECT) --audio-driver Dummy \
	    --picture=$(CURDIR)/$(GODOT_PROJECT)/godot.png > $(GODOT_PROJECT)/log 2>&1; \
	grep '^2 sheets' $(GODOT_PROJECT)/log || { cat $(GODOT_PROJECT)/log; exit 1; }; $(PYTHON) samples/check_paper.py $(GODOT_PROJECT)/godot.png
