// The static program may run where there is no configuration of fonts. Fontconfig then says that this is an error, and Cairo
// draws letters of its own: here is that without the error.

#include <cairo/cairo.h>
#include <fontconfig/fontconfig.h>
#include <unistd.h>

#include <cstdlib>

extern "C" {

void __real_cairo_select_font_face(cairo_t* context, const char* family, cairo_font_slant_t slant, cairo_font_weight_t weight);

/// __wrap_cairo_select_font_face is what Carom calls in place of cairo_select_font_face (--wrap). Where the machine has no
/// configuration of Fontconfig, it gives Fontconfig an empty one, once.
void __wrap_cairo_select_font_face(cairo_t* context, const char* family, cairo_font_slant_t slant, cairo_font_weight_t weight) {
  static const bool ready = [] {
    const bool configured = getenv("FONTCONFIG_FILE") != nullptr || getenv("FONTCONFIG_PATH") != nullptr ||
                            access("/etc/fonts/fonts.conf", R_OK) == 0;
    return configured || FcConfigSetCurrent(FcConfigCreate()) == FcTrue;
  }();
  static_cast<void>(ready);
  __real_cairo_select_font_face(context, family, slant, weight);
}
}
