#pragma once
// One moment onto a Cairo surface.

#include "pages/painter.hpp"

#include <cairo.h>

#include <memory>

namespace carom::detail {

struct DestroyCairo {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Context = std::unique_ptr<cairo_t, DestroyCairo>;
using Surface = std::unique_ptr<cairo_surface_t, DestroyCairo>;

/// The data of a drawing.
struct Subject {
  const Scene& scene;
  const Disks& disks;
  const std::vector<std::string>& species_names;
  const Look& look;
  const Ranges& ranges;
  const Layout& layout;
};

void draw_moment(cairo_t* context, const Subject& subject, const Moment& moment);

/// Below the box: the clock on the left, and on the right what the colours mean.
void draw_caption(cairo_t* context, const Subject& subject, const Moment& moment);

inline void set_colour(cairo_t* context, const Colour& colour, double alpha = 1.0) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, alpha);
}

}  // namespace carom::detail
