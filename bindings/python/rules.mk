# The wheel of the Python binding. `make python`, in the Makefile, tests the binding itself.

WHEEL := build/wheel

.PHONY: package-python bench-python pygame pygame-test

# A wheel and a source package. Each is installed in an environment of its own, with cffi as it is on this machine, and runs
# the first program alone. PLATFORM=manylinux_2_28_x86_64: the tag of the wheel, as `auditwheel show` has it.
NEW_PYTHON = rm -rf $(WHEEL)/venv && $(PYTHON) -m venv --system-site-packages $(WHEEL)/venv && \
    $(WHEEL)/venv/bin/pip install --quiet --no-index --no-deps
FIRST_CUT = cd $(WHEEL) && env -u KIRI_LIBRARY -u PYTHONPATH venv/bin/python

package-python: $(BUILD)/libkiri.so
	@rm -rf $(WHEEL) && $(PYTHON) bindings/python/pack.py $< $(WHEEL) $(PLATFORM) && cp bindings/python/first_cut.py $(WHEEL)
	@$(PYTHON) -c 'import venv, ensurepip' 2> /dev/null || { echo "package-python: no venv, packages not tested"; exit 0; }; \
	for package in $(WHEEL)/kiri_sheets-*.whl $(WHEEL)/kiri_sheets-*.tar.gz; do \
	    $(NEW_PYTHON) $$package && ($(FIRST_CUT) first_cut.py) && ($(FIRST_CUT) -c "import kiri, pathlib; here = pathlib.Path(kiri.__file__).parent; \
	        assert 'venv' in str(here) and all((here / name).exists() for name in ('include/kiri/kiri.h', 'libkiri.so', 'py.typed'))") || exit 1; done

bench-python: $(BUILD)/libkiri.so
	@KIRI_LIBRARY=$< PYTHONPATH=bindings/python $(PYTHON) bindings/python/bench.py

# A host in pygame. The test plays it without a window, and needs pygame: pip install pygame-ce. Pictures are in build/pygame.
NEEDS_pygame := $(NEEDS_lib) python3-cffi python3-pygame

pygame: packages-pygame
	@$(MAKE) --no-print-directory $(BUILD)/libkiri.so
	KIRI_LIBRARY=$(BUILD)/libkiri.so $(PYTHON) samples/pygame/main.py

pygame-test: $(BUILD)/libkiri.so
	@KIRI_LIBRARY=$< sh samples/pygame/test.sh $(PYTHON) build/pygame
