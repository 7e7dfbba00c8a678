// What is here: packings of the library, from designs and files. What is not: how they are made (geometry/).
#include "perfora/pack.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "io/files.h"
#include "io/lock.h"
#include "io/memory.h"
#include "optimize/evaluate/estimate.h"
#include "optimize/evaluate/pack_file.h"
#include "optimize/evaluate/run_output.h"
#include "perfora/inside.h"
#include "results/json.h"
#include "results/pack_file.h"
#include "results/status.h"

namespace perfora {

namespace {

/// Arcs become chords that leave the rim by at most this share of the largest side of the block.
constexpr double outline_tolerance = 1e-5;

void add_arc(const geometry::Arc& arc, double tolerance, Outline& outline) {
  constexpr double corner = 1e-12;
  int chords = 0;
  if (arc.radius > tolerance && arc.to > arc.from) {
    const double largest = 2.0 * std::acos(1.0 - tolerance / arc.radius);
    chords = static_cast<int>(std::ceil((arc.to - arc.from) / largest));
  }
  // The end of a full turn is its beginning.
  const bool whole = arc.to - arc.from > 2.0 * std::numbers::pi - corner;
  for (int k = 0; k < chords + (whole ? 0 : 1); ++k) {
    const double angle = chords == 0 ? arc.from : arc.from + (arc.to - arc.from) * k / chords;
    outline.x.push_back(arc.centre.x + arc.radius * std::cos(angle));
    outline.y.push_back(arc.centre.y + arc.radius * std::sin(angle));
  }
}

}  // namespace

Discs discs_of(const geometry::Packing& packing) {
  return {packing.x, packing.y, packing.radius};
}

std::vector<Outline> outlines_of(const geometry::PerforationLayout& layout) {
  const double tolerance = outline_tolerance * std::max(layout.width, layout.height);
  std::vector<Outline> outlines;
  for (const geometry::Perforation& hole : layout.perforations) {
    Outline outline;
    for (const geometry::Arc& arc : hole.outline(tolerance)) add_arc(arc, tolerance, outline);
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

namespace {

Packing public_packing(const geometry::Packing& periodic, const geometry::Packing& clipped,
                       const geometry::PerforationLayout& layout, const results::PackSummary& summary,
                       const nlohmann::json& record) {
  Packing packing;
  const auto status = results::status_called(record.at("status").get<std::string>());
  packing.status = status_of(status.value_or(results::RunStatus::failed));
  packing.reason = record.at("reason").get<std::string>();
  packing.width = layout.width;
  packing.height = layout.height;
  packing.discs = discs_of(clipped);
  packing.periodic = discs_of(periodic);
  packing.openings = outlines_of(layout);
  packing.measures = measures_of(summary);
  return packing;
}

}  // namespace

double Packing::measure(const std::string& key) const {
  return value_of(measures, key);
}

Packing pack(const Design& design, const PackOptions& options) {
  return at_boundary([&] {
    refuse_negative(options.replicate);
    const optimize::DesignFile file = Inside::file(design).clone();
    static_cast<void>(file.validate(optimize::Purpose::block));
    static_cast<void>(optimize::check_cost(file, thread_count(options.threads), io::usable_memory_bytes()));
    io::OutputLock lock;
    if (!options.file.empty()) {
      lock = optimize::claim_pack_output(options.file, options.force);
    }
    optimize::EvaluateOptions making;
    making.threads = thread_count(options.threads);
    ProgressRelay relay(options.progress, options.stop);
    making.cancellation = relay.token();
    making.progress = relay.callback();
    std::optional<optimize::RecordedPacking> made;
    try {
      made = optimize::pack_with_record(file, making, options.replicate);
    } catch (const io::Cancelled&) {
    }
    relay.rethrow();
    if (!made) {
      Packing stopped;
      stopped.status = Status::stopped;
      stopped.reason = "stopped";
      return stopped;
    }
    const auto& [packed, performance, record] = *made;
    if (!options.file.empty() && packed.periodic.quality.reached)
      optimize::write_pack_file(options.file, file, packed, record, "", options.replicate);
    return public_packing(packed.periodic, packed.clipped, packed.layout, packed.summary, record);
  });
}

Packing read_packing(const std::filesystem::path& file) {
  return at_boundary([&] {
    const results::PackResult pack = results::read_pack(file);
    return public_packing(pack.periodic, pack.clipped, pack.layout, results::pack_summary_from_json(pack.summary),
                          pack.summary);
  });
}

}  // namespace perfora
