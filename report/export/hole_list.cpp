// What is here: sizes counted, equal distances put together. What is not: where they are drawn (block_drawing.cpp).
#include "report/export/hole_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/export/drawing.h"

namespace perfora::report {
namespace {

constexpr double list_mm = 1e3;
constexpr double same_place = 0.5e-6;  // m: what mm_text with three digits cannot tell apart

/// A circle fills its own width: other shapes of equal extents do not.
bool is_round(const geometry::Perforation& hole) {
  const double d = hole.largest_extent();
  return std::abs(hole.area() - 0.25 * std::numbers::pi * d * d) < 1e-6 * d * d;
}

bool is_diameter(const std::string& size) {
  return size.starts_with("Ø");
}

}  // namespace

HoleList::HoleList(const geometry::PerforationLayout& layout) : layout_(layout) {
  for (const geometry::Perforation& hole : layout.perforations) {
    const std::string length = mm_text(list_mm * hole.largest_extent(), 3);
    sizes_.push_back(is_round(hole) ? "Ø" + length : length + " x " + mm_text(list_mm * hole.smallest_extent(), 3));
  }
}

std::string HoleList::size_text(std::size_t hole) const {
  return sizes_[hole];
}

bool HoleList::first_of_its_size(std::size_t hole) const {
  return std::find(sizes_.begin(), sizes_.end(), sizes_[hole]) == sizes_.begin() + static_cast<std::ptrdiff_t>(hole);
}

std::string HoleList::summary() const {
  std::vector<std::pair<std::size_t, std::string>> counts;
  for (std::size_t k = 0; k < sizes_.size(); ++k)
    if (first_of_its_size(k))
      counts.emplace_back(static_cast<std::size_t>(std::count(sizes_.begin(), sizes_.end(), sizes_[k])), sizes_[k]);
  std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (counts.empty()) return "none";
  if (!few_sizes()) {
    const auto smaller = [this](const geometry::Perforation& a, const geometry::Perforation& b) {
      return a.largest_extent() < b.largest_extent();
    };
    const auto [least, most] = std::minmax_element(layout_.perforations.begin(), layout_.perforations.end(), smaller);
    const auto text = [this](auto hole) {
      return sizes_[static_cast<std::size_t>(hole - layout_.perforations.begin())];
    };
    return fmt::format("{}, {} to {}", sizes_.size(), text(least), text(most));
  }
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k)
    text += fmt::format("{}{} {} {}", k == 0 ? "" : ", ", counts[k].first, is_diameter(counts[k].second) ? "x" : "of",
                        counts[k].second);
  return text;
}

bool HoleList::few_sizes() const {
  constexpr std::ptrdiff_t most = 3;
  std::ptrdiff_t sizes = 0;
  for (std::size_t k = 0; k < sizes_.size(); ++k) sizes += first_of_its_size(k) ? 1 : 0;
  return sizes <= most;
}

std::vector<Chain> HoleList::chain(std::vector<double> places) const {
  constexpr std::size_t most_places = 12;
  std::sort(places.begin(), places.end());
  std::vector<double> kept;
  for (const double place : places)
    if (kept.empty() || place - kept.back() > same_place) kept.push_back(place);
  if (kept.empty()) return {};
  bool equal = true;
  for (std::size_t k = 2; k < kept.size(); ++k)
    equal = equal && std::abs((kept[k] - kept[k - 1]) - (kept[1] - kept[0])) < same_place;
  if (!equal && kept.size() > most_places) return {};
  std::vector<Chain> chain;
  if (kept.front() > same_place) chain.push_back({0.0, kept.front(), mm_text(list_mm * kept.front(), 3)});
  if (equal && kept.size() > 2) {
    const double whole = kept.back() - kept.front(), count = static_cast<double>(kept.size() - 1);
    chain.push_back({kept.front(), kept.back(),
                     fmt::format("{} x {} = {}", kept.size() - 1, mm_text(list_mm * whole / count, 3),
                                 mm_text(list_mm * whole, 3))});
    return chain;
  }
  for (std::size_t k = 1; k < kept.size(); ++k)
    chain.push_back({kept[k - 1], kept[k], mm_text(list_mm * (kept[k] - kept[k - 1]), 3)});
  return chain;
}

std::vector<Chain> HoleList::chain_x() const {
  std::vector<double> places;
  for (const geometry::Perforation& hole : layout_.perforations) places.push_back(hole.x);
  return chain(std::move(places));
}

std::vector<Chain> HoleList::chain_y() const {
  std::vector<double> places;
  for (const geometry::Perforation& hole : layout_.perforations) places.push_back(hole.y);
  return chain(std::move(places));
}

}  // namespace perfora::report
