# make package-meson: a wrap of Meson, with the sources beside it. A project copies both to its subprojects.

.PHONY: package-meson

MESON := build/meson
MESON_ROOT := kiri-$(VERSION)

package-meson:
	@rm -rf $(MESON) && mkdir -p $(MESON)/packagefiles && \
	tar -czf $(MESON)/packagefiles/$(MESON_ROOT).tar.gz --transform 's|^bindings/meson/||' --transform 's|^|$(MESON_ROOT)/|' \
	    LICENSE include src bindings/meson/meson.build && \
	printf '%s\n' '[wrap-file]' 'directory = $(MESON_ROOT)' 'source_filename = $(MESON_ROOT).tar.gz' \
	    "source_hash = $$(sha256sum < $(MESON)/packagefiles/$(MESON_ROOT).tar.gz | cut -d ' ' -f 1)" '' \
	    '[provide]' 'dependency_names = kiri' > $(MESON)/kiri.wrap && echo "  $(MESON)/kiri.wrap"
