// What is here: one compression: rows, frames, checkpoints, stopping, summary. What is not: step and rate
// (run_setup.h).
#include "solver/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "io/memory.h"
#include "io/progress.h"
#include "io/text.h"
#include "results/measures.h"
#include "results/run_file.h"
#include "solver/checkpoint.h"
#include "solver/fragments.h"
#include "solver/frame.h"
#include "solver/run_folder.h"
#include "solver/run_setup.h"
#include "solver/simulation.h"

namespace perfora::solver {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double peak_passed_ratio =
    0.8;  // a row below this fraction of the largest row so far ends the search for the first peak
constexpr double latest_peak =
    10.0;  // times the estimated peak strain: a later fall is a serration of the rubble, not the first peak
constexpr double least_peak_strain = 2e-4;  // rows before that are too close to zero stress to tell a fall
constexpr double unstable_overlap = 1.0;  // overlap over <d> at which discs pass through each other: the run has failed
constexpr std::int64_t steps_between_looks = 64;  // at the clock and the request to stop

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rows after which a frame is written, the first peak aside.
bool frame_due(const OutputOptions& output, std::int64_t row, std::int64_t rows) {
  const auto at_multiple = [&](double stride) {
    const auto every = std::max<std::int64_t>(1, std::llround(stride / output.history_interval));
    return row % every == 0;
  };
  if (!output.frame_strains.empty()) {
    for (const double strain : output.frame_strains)
      if (row == std::llround(strain / output.history_interval)) return true;
    return false;
  }
  if (output.frames == FrameChoice::none) return false;
  return row == rows || at_multiple(output.frames == FrameChoice::all ? 0.01 : 0.1);
}

/// One run in progress.
class Run {
 public:
  explicit Run(const RunRequest& request)
      : request_(request),
        setup_(set_up_run(request)),
        folder_(request.run_file),
        original_bonds_(count_bonds_per_disc(setup_.network, request.clipped->x.size())) {
    const StrengthStatistics strength = strength_statistics(setup_.network);
    results::Summary& summary = response_.summary;
    summary.noise_mean = strength.mean;
    summary.noise_std = strength.deviation;
    summary.noise_min = strength.smallest;
    summary.noise_max = strength.largest;
    response_.discs = request.clipped->size();
    response_.bonds = setup_.network.size();
    response_.bonds_per_disc =
        response_.discs > 0 ? 2.0 * static_cast<double>(response_.bonds) / static_cast<double>(response_.discs) : 0.0;
    summary.time_step = setup_.plan.time_step;
    summary.step_margin = setup_.critical_step / setup_.plan.time_step;
    SimulationInput input;
    input.clipped = &setup_.specimen.packing;
    input.network = setup_.network;
    input.options = request.options;
    input.masses = setup_.masses;
    input.cell.start = setup_.specimen.cell;  // the width is held, the plan moves the height
    input.loading = setup_.plan;
    input.block = setup_.specimen.block;
    input.walls = setup_.specimen.walls;
    input.time_step = setup_.plan.time_step;
    input.mean_diameter = request.mean_diameter;
    input.threads = request.threads;
    simulation_.emplace(std::move(input));
  }

  Response execute() {
    start();
    loop();
    finish();
    return std::move(response_);
  }

 private:
  /// What a resumed run must share with the run it goes on from: configuration, seeds, results version and instruction
  /// set.
  std::string identity() const {
    return fmt::format("# results_version {}, seeds {}, kernel {}\n", request_.provenance.results_version,
                       request_.provenance.seeds, simulation_->simd()) +
           request_.provenance.config;
  }

  bool writes() const { return !request_.run_file.empty(); }

  void start() {
    started_ = last_checkpoint_ = Clock::now();
    if (writes()) {
      if (request_.resume && folder_.can_resume(identity(), request_.in_names_of_today)) {
        progress_ = read_checkpoint(folder_.checkpoint_file(), *simulation_);
        for (const double stress : progress_.history.stress_yy)
          largest_row_stress_ = std::max(largest_row_stress_, stress);
        io::log_info(fmt::format("resuming at strain {:.4f}", simulation_->strain()));
      } else {
        folder_.start_afresh(identity());
      }
    }
    first_step_ = simulation_->steps();
    first_bond_steps_ = simulation_->bond_steps();
    earlier_seconds_ = progress_.seconds;
    if (progress_.history.rows() == 0) {
      add_row();
      const auto& strains = request_.options.output.frame_strains;
      const bool wants_start = strains.empty() || std::find(strains.begin(), strains.end(), 0.0) != strains.end();
      if (wants_frames() && wants_start) keep_frame();
    }
  }

  bool wants_frames() const {
    return writes() &&
           (request_.options.output.frames != FrameChoice::none || !request_.options.output.frame_strains.empty());
  }

  void loop() {
    while (progress_.rows < setup_.rows) {
      simulation_->step();
      const std::int64_t steps = simulation_->steps();
      const LoadingState& path = simulation_->loading();
      if (path.steps == 0.0 && static_cast<std::int64_t>(path.segment) % setup_.plan.segments_per_row == 0) {
        ++progress_.rows;
        add_row();
        if (failed()) return;
        after_row();
      }
      if (steps % steps_between_looks == 0 && look()) return;
    }
    response_.summary.status = results::RunStatus::completed;
    response_.summary.reason = results::reached_text(simulation_->strain());
  }

  /// At the clock, the request to stop and the checkpoint; true: stop here.
  bool look() {
    const double now = seconds_since(started_);
    const bool out_of_time = request_.wall_time_limit > 0.0 && now > request_.wall_time_limit;
    const bool cancelled = request_.cancellation.requested(), stopping = cancelled || out_of_time;
    // A state that cannot be resumed is never stored.
    if (!std::isfinite(simulation_->stress().yy) || !std::isfinite(simulation_->kinetic_energy_at_half_step())) {
      response_.summary.status = results::RunStatus::failed;
      response_.summary.reason =
          fmt::format("unstable step: stress is not a number at strain {:.4f}", simulation_->strain());
      return true;
    }
    if (writes() && (stopping || seconds_since(last_checkpoint_) > request_.options.output.checkpoint_interval)) {
      progress_.seconds = earlier_seconds_ + now;
      write_checkpoint(folder_.checkpoint_file(), *simulation_, progress_);
      last_checkpoint_ = Clock::now();
    }
    if (stopping) {
      response_.summary.status = results::RunStatus::stopped;
      response_.summary.reason = cancelled ? "signal" : "wall time";
    }
    return stopping;
  }

  void add_row() {
    const Virial stress = simulation_->row_stress();
    const Ledger energy = simulation_->ledger();
    const double strain = simulation_->strain();
    if (fragments_at_breaks_ != static_cast<std::int64_t>(simulation_->events().size())) {
      fragments_ = find_fragments(simulation_->network(), simulation_->discs().radius);
      fragments_at_breaks_ = static_cast<std::int64_t>(simulation_->events().size());
    }
    results::History& h = progress_.history;
    h.strain_yy.push_back(strain);
    h.strain_yy_log.push_back(-std::log(1.0 - strain));
    h.stress_yy.push_back(stress.yy);
    h.stress_xx.push_back(stress.xx);
    h.stress_xy.push_back(0.5 * (stress.xy + stress.yx));
    h.stress_asymmetry.push_back(std::fabs(stress.xy - stress.yx));
    h.broken_bonds.push_back(static_cast<double>(simulation_->events().size()));
    h.fragments.push_back(fragments_.count);
    h.contacts.push_back(static_cast<double>(simulation_->contacts()));
    h.rate.push_back(
        h.time.empty() ? 0.0 : (strain - h.strain_yy[h.time.size() - 1]) / (simulation_->time() - h.time.back()));
    h.time.push_back(simulation_->time());
    h.external_work.push_back(energy.external_work);
    h.elastic_bonds.push_back(energy.elastic_bonds);
    h.elastic_contacts.push_back(energy.elastic_contacts);
    h.kinetic.push_back(energy.kinetic);
    h.damage.push_back(energy.damage);
    h.friction.push_back(energy.friction);
    h.viscous.push_back(energy.viscous);
    h.cundall.push_back(energy.cundall);
    add_pressures();
    simulation_->reset_row();
    find_peak(stress.yy, strain, energy);
    add_ends();
  }

  /// The first peak is known once a row has fallen far enough below the largest so far.
  void find_peak(double stress, double strain, const Ledger& energy) {
    if (!simulation_->peak_frozen() && energy.elastic_bonds > 0.0) {
      if (stress > largest_row_stress_) {
        largest_row_stress_ = stress;
        largest_row_strain_ = strain;
      }
      if (strain > least_peak_strain && stress < peak_passed_ratio * largest_row_stress_ &&
          largest_row_strain_ < latest_peak * setup_.loading.peak_strain) {
        simulation_->freeze_peak();
        peak_just_passed_ = true;
      } else {
        progress_.kinetic_ratio = energy.kinetic / energy.elastic_bonds;
      }
    }
  }

  /// What the summary would say if the run ended here. A run resumed from a checkpoint without these columns goes on
  /// without them.
  void add_ends() {
    results::History& h = progress_.history;
    if (h.peak_passed.size() + 1 != h.rows()) return;
    h.steps.push_back(static_cast<double>(simulation_->steps()));
    h.broken_in_tension.push_back(static_cast<double>(broken_in_tension()));
    h.largest_fragment.push_back(fragments_.largest_fraction);
    h.largest_overlap.push_back(simulation_->largest_overlap() / request_.mean_diameter);
    h.largest_asymmetry.push_back(simulation_->largest_asymmetry());
    h.peak_passed.push_back(simulation_->peak_frozen() ? 1.0 : 0.0);
  }

  std::int64_t broken_in_tension() {
    const std::vector<results::BreakEvent>& events = simulation_->events();
    for (; counted_events_ < events.size(); ++counted_events_)
      if (events[counted_events_].mode == results::BreakMode::tension) ++counted_in_tension_;
    return counted_in_tension_;
  }

  /// Mean pressures on platens and side walls; their columns exist only where such walls are.
  void add_pressures() {
    results::History& h = progress_.history;
    const Walls& walls = simulation_->walls();
    for (std::size_t w = 0; w < walls.places().size(); ++w) {
      if (!walls.places()[w].edge) continue;
      std::vector<double>* const columns[] = {&h.platen_stress_bottom, &h.platen_stress_top, &h.wall_stress_left,
                                              &h.wall_stress_right};
      columns[static_cast<std::size_t>(walls.places()[w].side)]->push_back(walls.row_pressure(w));
    }
  }

  void after_row() {
    if (wants_frames() && (frame_due(request_.options.output, progress_.rows, setup_.rows) ||
                           (peak_just_passed_ && request_.options.output.frame_strains.empty())))
      keep_frame();
    peak_just_passed_ = false;
    if (request_.progress) {
      const double elapsed = seconds_since(started_);
      const double rate = elapsed > 0.0 ? static_cast<double>(simulation_->steps() - first_step_) / elapsed : 0.0;
      const double strain = simulation_->strain(), stress = progress_.history.stress_yy.back();
      request_.progress({static_cast<double>(progress_.rows) / static_cast<double>(setup_.rows),
                         fmt::format("strain {:.2f} %, stress {}, {} steps/s", 100.0 * strain,
                                     io::quantity(stress, io::Dimension::stress), io::count(rate)),
                         strain, stress});
    }
  }

  void keep_frame() {
    results::write_frame(folder_.frame_file(progress_.frames++), take_frame(*simulation_, original_bonds_));
  }

  bool failed() {
    const results::History& h = progress_.history;
    const double overlap = simulation_->largest_overlap() / request_.mean_diameter;
    if (std::isfinite(h.stress_yy.back()) && std::isfinite(h.kinetic.back()) && overlap < unstable_overlap)
      return false;
    response_.summary.status = results::RunStatus::failed;
    response_.summary.reason =
        fmt::format("unstable step: largest overlap {:.3g} <d> at strain {:.4f}", overlap, simulation_->strain());
    return true;
  }

  void finish() {
    results::Summary& s = response_.summary;
    const results::History& h = progress_.history;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    s.steps = simulation_->steps();
    s.final_strain = simulation_->strain();
    results::measure_rate(h, s);
    s.first_peak_stress = simulation_->peak_frozen() ? simulation_->peak_stress() : nan;
    s.first_peak_strain = simulation_->peak_frozen() ? simulation_->peak_strain() : nan;
    const double area = request_.layout->width * request_.layout->height;
    results::measure_curve(h, request_.options.measures.plateau_start, request_.options.measures.plateau_end, area, s);
    s.broken_bonds = static_cast<std::int64_t>(simulation_->events().size());
    s.broken_in_tension = broken_in_tension();
    s.broken_in_shear = s.broken_bonds - s.broken_in_tension;
    if (fragments_.label.empty() || fragments_at_breaks_ != s.broken_bonds)
      fragments_ = find_fragments(simulation_->network(), simulation_->discs().radius);
    s.fragments = fragments_.count;
    s.largest_fragment_fraction = fragments_.largest_fraction;
    s.max_overlap_in_run = simulation_->largest_overlap() / request_.mean_diameter;
    s.energy_residual = results::energy_residual(h, results::residual_from_strain);
    s.stress_asymmetry =
        simulation_->peak_stress() > 0.0 ? simulation_->largest_asymmetry() / simulation_->peak_stress() : nan;
    const double modulus = results::loading_modulus(h, simulation_->peak_stress(), simulation_->peak_strain());
    const double wave_speed = std::sqrt(modulus / setup_.loading.bulk_density);
    s.transits_before_peak = simulation_->peak_time() * wave_speed / request_.layout->height;
    s.kinetic_ratio_at_peak = simulation_->peak_frozen() ? progress_.kinetic_ratio : nan;

    results::Performance& p = response_.performance;
    const double seconds = seconds_since(started_);
    const double steps = static_cast<double>(s.steps - first_step_);
    const double bond_steps = simulation_->bond_steps() - first_bond_steps_;
    p.seconds = earlier_seconds_ + seconds;
    p.steps_per_second = seconds > 0.0 ? steps / seconds : 0.0;
    p.ns_per_bond_step = bond_steps > 0.0 ? 1e9 * seconds / bond_steps : nan;
    p.threads = request_.options.dynamics.kernel == KernelChoice::reference ? 1 : request_.threads;
    p.simd = simulation_->simd();
    p.peak_memory = io::peak_memory_bytes();
    response_.history = h;
    if (!writes()) return;
    results::write_run(request_.run_file, record(), folder_.frame_files(progress_.frames), request_.periodic);
    if (s.status != results::RunStatus::stopped) folder_.remove();  // a stopped run can be resumed from it
  }

  /// The run as its file holds it, frames aside.
  results::RunResult record() const {
    results::RunResult run;
    run.status = results::status_name(response_.summary.status);
    run.reason = response_.summary.reason;
    run.provenance = request_.provenance;
    run.provenance.simd = response_.performance.simd;
    run.provenance.threads = response_.performance.threads;
    run.provenance.seconds = response_.performance.seconds;
    run.width = request_.layout->width;
    run.height = request_.layout->height;
    run.mean_diameter = request_.mean_diameter;
    const BoundaryOptions& boundary = request_.options.boundary;
    run.edges = {boundary.top_bottom == TopBottom::platens, boundary.sides == Sides::walls,
                 boundary.sides == Sides::free};
    run.history = progress_.history;
    run.events = simulation_->events();
    const BondNetwork& network = simulation_->network();
    run.bonds.reference_length = network.reference_length;
    run.bonds.strength_factor.assign(network.strength.begin(), network.strength.end());
    for (std::size_t b = 0; b < network.i.size(); ++b)
      run.bonds.pairs.insert(run.bonds.pairs.end(), {network.i[b], network.j[b]});
    run.layout = *request_.layout;
    run.clipped = *request_.clipped;
    run.summary = request_.summary ? request_.summary(response_) : nlohmann::json::object();
    return run;
  }

  const RunRequest& request_;
  RunSetup setup_;
  RunFolder folder_;
  std::vector<std::int32_t> original_bonds_;
  std::optional<Simulation> simulation_;
  RunProgress progress_;
  Response response_;
  Fragments fragments_;
  std::int64_t fragments_at_breaks_ = -1;
  std::size_t counted_events_ = 0;
  std::int64_t counted_in_tension_ = 0;
  double largest_row_stress_ = 0.0, largest_row_strain_ = 0.0;
  bool peak_just_passed_ = false;
  Clock::time_point started_, last_checkpoint_;
  std::int64_t first_step_ = 0;
  double first_bond_steps_ = 0.0;
  double earlier_seconds_ = 0.0;
};

}  // namespace

Response run_compression(const RunRequest& request) {
  return Run(request).execute();
}

}  // namespace perfora::solver
