// What is here: drawing of blocks. What is not: the colouring of fragments (fragment_colours.cpp).
#include "report/block_picture.h"
#include "results/frame.h"
#include "results/run_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/text.h"

namespace perfora::report {
namespace {

/// From this radius on (pixels) discs are shown one by one over the closed ground.
constexpr double visible_radius = 2.2;
/// Then the ground shows around each of them as a rim.
constexpr double rim_fraction = 0.9;

struct Disc {
  double x, y, radius;
};

/// Calls draw(disc) for the disc and those of its periodic images that reach into the cell.
template <class Draw>
void for_images(const BlockPicture& block, std::size_t k, double radius, const Draw& draw) {
  const double shear = block.h_xy / block.h_yy;
  const double reach = radius * (1.0 + std::abs(shear)) + block.beyond;
  const int images_x = block.edges.open_x() ? 0 : 1, images_y = block.edges.platens ? 0 : 1;
  for (int b = -images_y; b <= images_y; ++b) {
    const double y = block.y[k] + b * block.h_yy;
    if (y < -radius || y > block.h_yy + radius) continue;
    for (int a = -images_x; a <= images_x; ++a) {
      const double x = block.x[k] + a * block.h_xx + b * block.h_xy;
      const double from_left = x - shear * y;
      if (from_left < -reach || from_left > block.h_xx + reach) continue;
      draw(Disc{x, y, radius});
    }
  }
}

void outline_path(cairo_t* context, const BlockPicture& block) {
  cairo_new_path(context);
  cairo_move_to(context, -block.beyond, 0.0);
  cairo_line_to(context, block.h_xx + block.beyond, 0.0);
  cairo_line_to(context, block.h_xx + block.beyond + block.h_xy, block.h_yy);
  cairo_line_to(context, block.h_xy - block.beyond, block.h_yy);
  cairo_close_path(context);
}

/// User space of `context` becomes metres of the block, y upwards, for a block drawn in `box`.
void enter_block(cairo_t* context, const Box& box, const BlockPicture& block) {
  const double scale = box.width / block.extent_x();
  cairo_translate(context, box.x + (block.beyond - std::min(0.0, block.h_xy)) * scale, box.bottom());
  cairo_scale(context, scale, -scale);
}

/// The edges of the block, in the width that says what stands there.
void draw_edges(cairo_t* context, const Box& box, const BlockPicture& block) {
  constexpr double thin = 1.6, bar = 6.0;
  const auto line = [&](double x0, double y0, double x1, double y1, double width) {
    cairo_save(context);
    enter_block(context, box, block);
    cairo_new_path(context);
    cairo_move_to(context, x0, y0);
    cairo_line_to(context, x1, y1);
    cairo_restore(context);
    cairo_set_line_width(context, width);
    cairo_stroke(context);
  };
  set_colour(context, palette::ink);
  cairo_save(context);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_SQUARE);
  const double left = -block.beyond, right = block.h_xx + block.beyond, offset = block.h_xy;
  const double level = block.edges.platens ? bar : thin;
  line(left, 0.0, right, 0.0, level);
  line(left + offset, block.h_yy, right + offset, block.h_yy, level);
  if (!block.edges.free) {
    const double upright = block.edges.walls ? bar : thin;
    line(0.0, 0.0, offset, block.h_yy, upright);
    line(block.h_xx, 0.0, block.h_xx + offset, block.h_yy, upright);
  }
  cairo_restore(context);
}

/// How far discs reach beyond free sides, but no farther than is worth the room.
double shown_beyond(const BlockPicture& block) {
  constexpr double most_fraction = 0.5;
  double farthest = 0.0;
  for (std::size_t k = 0; k < block.x.size(); ++k)
    farthest = std::max({farthest, block.radius[k] - block.x[k], block.x[k] + block.radius[k] - block.h_xx});
  return std::min(farthest, most_fraction * block.h_xx);
}

/// Calls paint(context) on the path of every hole and every periodic image next to the cell, the layout drawn in `box`.
void for_outlines(cairo_t* context, const Box& box, const geometry::PerforationLayout& layout,
                  void (*paint)(cairo_t*)) {
  const double scale = box.width / layout.width;
  constexpr double visible = 0.1;  // of a point of the page: no one sees a rim that is off by less
  for (const geometry::Perforation& hole : layout.perforations) {
    // On the page y runs downwards: the rim is followed backwards, and its arcs keep their sense.
    std::vector<geometry::Arc> outline = hole.outline(visible / scale);
    std::reverse(outline.begin(), outline.end());
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b) {
        cairo_new_path(context);
        for (const geometry::Arc& arc : outline)
          cairo_arc(context, box.x + (arc.centre.x + a * layout.width) * scale,
                    box.bottom() - (arc.centre.y + b * layout.height) * scale, arc.radius * scale, -arc.to, -arc.from);
        cairo_close_path(context);
        paint(context);
      }
  }
}

void paint_discs(cairo_t* context, const BlockPicture& block, bool ground, double rim) {
  for (std::size_t k = 0; k < block.x.size(); ++k) {
    const double radius = block.radius[k] * (ground ? 1.0 + block.growth[k] : rim_fraction);
    set_colour(context, ground ? mix(block.colour[k], palette::ink, rim) : block.colour[k]);
    for_images(block, k, radius, [&](const Disc& disc) {
      cairo_new_sub_path(context);
      cairo_arc(context, disc.x, disc.y, disc.radius, 0.0, 2.0 * std::numbers::pi);
      cairo_fill(context);
    });
  }
}

double median_radius(const BlockPicture& block) {
  if (block.radius.empty()) return 0.0;
  std::vector<double> radii = block.radius;
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

/// Share of dark red: nothing for the few bonds every disc near a wall loses, much for the faces of a crack. Crumbs
/// have lost nearly all by their nature.
double damage_tint(double damage, int hue) {
  constexpr double unseen = 0.15;
  if (hue == dust_colour) return 0.0;
  return std::clamp((damage - unseen) / (1.0 - unseen), 0.0, 1.0) * (hue == main_colour ? 1.0 : 0.7);
}

}  // namespace

double BlockPicture::extent_x() const {
  return h_xx + 2.0 * beyond + std::abs(h_xy);
}

BlockPicture picture_of_frame(const results::Frame& frame, const geometry::Packing& clipped,
                              const results::Edges& edges) {
  BlockPicture picture;
  picture.edges = edges;
  picture.h_xx = frame.info.h_xx;
  picture.h_xy = frame.info.h_xy;
  picture.h_yy = frame.info.h_yy;
  picture.radius = clipped.radius;
  const auto& hues = palette::fragments();
  const std::vector<int> chosen = colour_fragments(frame, clipped.radius, static_cast<int>(hues.size()));
  for (std::size_t k = 0; k < clipped.radius.size(); ++k) {
    picture.x.push_back(frame.position[2 * k]);
    picture.y.push_back(frame.position[2 * k + 1]);
    const int hue = chosen[static_cast<std::size_t>(frame.fragment[k])];
    const Colour plain = hue == main_colour
                             ? palette::concrete
                             : (hue == dust_colour ? palette::dust : hues[static_cast<std::size_t>(hue)]);
    picture.colour.push_back(mix(plain, palette::damaged, damage_tint(frame.damage[k], hue)));
    picture.growth.push_back(hue == dust_colour ? 0.0 : bonded_growth * (1.0 - std::clamp(frame.damage[k], 0.0, 1.0)));
  }
  if (edges.free) picture.beyond = shown_beyond(picture);
  return picture;
}

Colour size_colour(double fraction) {
  return mix(hex(0xf0e2c0), hex(0x2f5d7c), std::clamp(fraction, 0.0, 1.0));
}

BlockPicture picture_of_packing(const geometry::Packing& packing) {
  BlockPicture picture;
  picture.h_xx = packing.width;
  picture.h_yy = packing.height;
  picture.x = packing.x;
  picture.y = packing.y;
  picture.radius = packing.radius;
  picture.growth.assign(packing.x.size(), 0.0);
  const auto [low, high] = std::minmax_element(packing.radius.begin(), packing.radius.end());
  for (double radius : packing.radius)
    picture.colour.push_back(size_colour(*high > *low ? (radius - *low) / (*high - *low) : 0.5));
  return picture;
}

Box fit_block(const BlockPicture& picture, const Box& room, double vertical_fraction) {
  const double scale = std::min(room.width / picture.extent_x(), room.height / picture.h_yy);
  const double width = picture.extent_x() * scale;
  const double height = picture.h_yy * scale;
  return {room.x + (room.width - width) / 2.0, room.y + (room.height - height) * vertical_fraction, width, height};
}

void draw_block(Canvas& canvas, const Box& box, const BlockPicture& picture) {
  // Discs become an image also in vector files: tens of thousands of arcs make those slow to open.
  const double pixels = canvas.image_scale();
  const int columns = std::max(1, static_cast<int>(std::ceil(box.width * pixels)));
  const int rows = std::max(1, static_cast<int>(std::ceil(box.height * pixels)));
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, columns, rows);
  cairo_t* inside = cairo_create(image);
  cairo_scale(inside, columns / box.width, rows / box.height);
  enter_block(inside, {0.0, 0.0, box.width, box.height}, picture);
  outline_path(inside, picture);
  set_colour(inside, palette::paper);
  cairo_fill_preserve(inside);
  cairo_clip(inside);
  const bool one_by_one = median_radius(picture) * box.width / picture.extent_x() > visible_radius;
  paint_discs(inside, picture, true, one_by_one ? 0.22 : 0.04);
  if (one_by_one) paint_discs(inside, picture, false, 0.0);
  cairo_destroy(inside);

  cairo_t* context = canvas.context();
  cairo_save(context);
  cairo_translate(context, box.x, box.y);
  cairo_scale(context, box.width / columns, box.height / rows);
  cairo_set_source_surface(context, image, 0.0, 0.0);
  cairo_paint(context);
  cairo_restore(context);
  cairo_surface_destroy(image);

  draw_edges(context, box, picture);
}

void draw_fragment_key(Canvas& canvas, double x, double y) {
  const auto entry = [&](const Colour& colour, const std::string& text) {
    canvas.disc(x + 7.0, y - 5.5, 7.0, colour, palette::soft_ink, 0.8);
    canvas.text(x + 21.0, y, text, {.size = 15.0, .colour = palette::soft_ink});
    x += 21.0 + canvas.text_width(text, {.size = 15.0}) + 26.0;
  };
  entry(palette::concrete, "largest fragment");
  entry(palette::fragments()[0], "");
  x -= 36.0;
  entry(palette::fragments()[1], "");
  x -= 36.0;
  entry(palette::fragments()[2], "other fragments");
  entry(palette::damaged, "bonds lost");
  entry(palette::dust, "crumbs");
}

void draw_scale_bar(Canvas& canvas, double right, double y, double pixels_per_metre) {
  double length = 1e-3;
  for (double candidate : {1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 50e-3, 100e-3, 200e-3, 500e-3, 1.0})
    if (candidate * pixels_per_metre <= 110.0) length = candidate;
  const std::string text = io::quantity(length, io::Dimension::length);
  const TextStyle style{.size = 15.0, .colour = palette::soft_ink, .align = Align::right};
  const double left = right - length * pixels_per_metre;
  canvas.line(left, y - 5.0, right, y - 5.0, palette::soft_ink, 3.0);
  canvas.text(left - 8.0, y, text, style);
}

void draw_perforation_rims(Canvas& canvas, const Box& box, const geometry::PerforationLayout& layout,
                           const Colour& colour) {
  cairo_t* context = canvas.context();
  cairo_save(context);
  cairo_rectangle(context, box.x, box.y, box.width, box.height);
  cairo_clip(context);
  set_colour(context, colour);
  cairo_set_line_width(context, 1.8);
  for_outlines(context, box, layout, cairo_stroke);
  cairo_restore(context);
}

void draw_layout(Canvas& canvas, const Box& box, const geometry::PerforationLayout& layout) {
  canvas.fill(box, palette::concrete);
  cairo_t* context = canvas.context();
  cairo_save(context);
  cairo_rectangle(context, box.x, box.y, box.width, box.height);
  cairo_clip(context);
  set_colour(context, palette::paper);
  for_outlines(context, box, layout, cairo_fill);
  cairo_restore(context);
  draw_perforation_rims(canvas, box, layout, palette::concrete_edge);
  canvas.frame(box, palette::ink, 1.6);
}

}  // namespace perfora::report
