# The wheel of the Python binding. `make python`, in the Makefile, tests the binding itself.

WHEEL := build/wheel

.PHONY: package-python bench-python pygame pygame-test

# Installed in an environment of its own, with cffi as it is on this machine, and the first program run by it alone.
package-python: $(BUILD)/libkiri.so
	@rm -rf $(WHEEL) && $(PYTHON) bindings/python/wheel.py $< $(WHEEL)
	@$(PYTHON) -m venv --system-site-packages $(WHEEL)/venv || { echo "package-python: no venv, wheel not tested"; exit 0; }; \
	$(WHEEL)/venv/bin/pip install --quiet --no-index --no-deps $(WHEEL)/kiri-*.whl && \
	cp bindings/python/first_cut.py $(WHEEL) && cd $(WHEEL) && env -u KIRI_LIBRARY -u PYTHONPATH venv/bin/python first_cut.py && \
	env -u KIRI_LIBRARY -u PYTHONPATH venv/bin/python -c "import kiri, pathlib; here = pathlib.Path(kiri.__file__).parent; \
	    assert 'venv' in str(here) and (here / 'include/kiri/kiri.h').exists() and (here / 'libkiri.so').exists()"

bench-python: $(BUILD)/libkiri.so
	@KIRI_LIBRARY=$< PYTHONPATH=bindings/python $(PYTHON) bindings/python/bench.py

# A host in pygame. The test plays it without a window, and needs pygame: pip install pygame-ce. Pictures are in build/pygame.
NEEDS_pygame := $(NEEDS_lib) python3-cffi python3-pygame

pygame: packages-pygame
	@$(MAKE) --no-print-directory $(BUILD)/libkiri.so
	KIRI_LIBRARY=$(BUILD)/libkiri.so $(PYTHON) samples/pygame/main.py

pygame-test: $(BUILD)/libkiri.so
	@KIRI_LIBRARY=$< sh samples/pygame/test.sh $(PYTHON) build/pygame
