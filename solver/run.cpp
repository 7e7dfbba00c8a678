// What is here: one compression: frames, checkpoints, stopping, summary. What is not: step and rate (run_setup.h),
// samples (samples.h).
#include "solver/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "io/memory.h"
#include "io/progress.h"
#include "io/text.h"
#include "results/grade.h"
#include "results/measures.h"
#include "results/run_file.h"
#include "solver/energy_watch.h"
#include "solver/frame.h"
#include "solver/grade.h"
#include "solver/run_folder.h"
#include "solver/run_setup.h"
#include "solver/samples.h"
#include "solver/simulation.h"
#include "solver/thread_choice.h"

namespace perfora::solver {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double unstable_overlap = 1.0;  // overlap over <d> at which discs pass through each other: the run has failed
constexpr std::int64_t steps_between_looks = 64;  // at the clock and the request to stop

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Strains of frames beyond the start, rising, the first peak aside.
std::vector<double> frame_strains(const OutputOptions& output, double until) {
  std::vector<double> strains;
  if (!output.frame_strains.empty()) {
    for (const double strain : output.frame_strains)
      if (strain > 0.0 && strain <= until) strains.push_back(strain);
  } else if (output.frames != FrameChoice::none) {
    const int per_unit = output.frames == FrameChoice::all ? all_frames_a_strain : few_frames_a_strain;
    for (int k = 1; k < until * per_unit; ++k) strains.push_back(static_cast<double>(k) / per_unit);
    strains.push_back(until);
  }
  std::sort(strains.begin(), strains.end());
  return strains;
}

/// One run in progress. It is computed at grade 1; what leaves this class is of the grade that was asked for.
class Run {
 public:
  /// `request` at grade 1; it must outlive this.
  Run(const RunRequest& request, double grade)
      : request_(request),
        grade_(grade),
        setup_(set_up_run(request)),
        folder_(request.run_file),
        original_bonds_(count_bonds_per_disc(setup_.network, request.clipped->x.size())),
        frame_strains_(frame_strains(request.options.output, request.options.loading.until)),
        thread_choice_(request.options.dynamics.kernel == KernelChoice::reference ? 1 : request.threads) {
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
    summary.time_step = grade_.time * setup_.plan.time_step;
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
  /// What a resumed run must share with the one before: configuration, seeds, results version, instruction set.
  std::string identity() const {
    return fmt::format("# results_version {}, seeds {}, kernel {}\n", request_.provenance.results_version,
                       request_.provenance.seeds, simulation_->simd()) +
           request_.provenance.config;
  }

  bool writes() const { return !request_.run_file.empty(); }

  void start() {
    started_ = last_checkpoint_ = Clock::now();
    if (writes()) {
      if (request_.resume && folder_.holds_checkpoint()) {
        progress_ = folder_.resume(*simulation_, identity(), request_.comparable);
        io::log_info(fmt::format("resuming at strain {:.4f}", simulation_->strain()));
      } else {
        folder_.start_afresh();
      }
    }
    first_step_ = simulation_->steps();
    first_bond_steps_ = simulation_->bond_steps();
    earlier_seconds_ = progress_.seconds;
    const bool fresh = progress_.history.rows() == 0;
    samples_.emplace(progress_.history, progress_.centred_rows, request_.options.output.history_interval,
                     request_.options.loading.until, request_.mean_diameter);
    samples_->start(*simulation_);
    while (next_frame() <= simulation_->strain()) ++next_frame_;
    const auto& strains = request_.options.output.frame_strains;
    const bool wants_start = strains.empty() || std::find(strains.begin(), strains.end(), 0.0) != strains.end();
    if (fresh && wants_frames() && wants_start) keep_frame(frame_now());
  }

  bool wants_frames() const {
    return writes() &&
           (request_.options.output.frames != FrameChoice::none || !request_.options.output.frame_strains.empty());
  }

  void loop() {
    while (!at_end(setup_.plan, simulation_->loading())) {
      simulation_->step();
      if (thread_choice_.after_step(seconds_since(started_))) simulation_->set_threads(thread_choice_.threads());
      if (samples_->after_step(*simulation_) && !energies_close()) return;
      const double next = next_frame();
      if (wants_frames() && simulation_->strain() >= next) keep_due_frame();
      const LoadingState& path = simulation_->loading();
      if (path.steps == 0.0 && !after_segment(path)) return;
      if (simulation_->steps() % steps_between_looks == 0 && look()) return;
    }
    response_.summary.status = results::RunStatus::completed;
    response_.summary.reason = results::reached_text(simulation_->strain());
  }

  /// False: the run has failed.
  bool after_segment(const LoadingState& path) {
    PeakWatch& watch = progress_.watch;
    const bool looking = !simulation_->peak_frozen();
    if (looking && path.segment_stress > progress_.peak_frame_stress) {
      progress_.peak_frame_stress = path.segment_stress;
      progress_.peak_frame_strain = path.begin;
      if (wants_peak_frame()) {
        peak_frame_ = frame_now();
        progress_.peak_frame_step = simulation_->steps();
      }
    }
    if (!watch.ends_piece(path.segment_stress, path.begin - path.last_begin, path.begin)) return true;
    if (failed()) return false;
    if (looking) look_for_peak();
    if (request_.progress) report();
    return true;
  }

  void look_for_peak() {
    const Ledger energy = simulation_->ledger();
    if (!(energy.elastic_bonds > 0.0)) return;
    if (!progress_.watch.passed(setup_.loading.peak_strain)) {
      progress_.kinetic_ratio = energy.kinetic / energy.elastic_bonds;
      return;
    }
    simulation_->freeze_peak();
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
      write_peak_frame();  // first: a frame that a checkpoint names is there
      folder_.write_checkpoint(*simulation_, progress_, identity());
      last_checkpoint_ = Clock::now();
    }
    if (stopping) {
      response_.summary.status = results::RunStatus::stopped;
      response_.summary.reason = cancelled ? "signal" : "wall time";
    }
    return stopping;
  }

  void report() const {
    const double elapsed = seconds_since(started_);
    const double rate = elapsed > 0.0 ? static_cast<double>(simulation_->steps() - first_step_) / elapsed : 0.0;
    const double strain = path_strain(simulation_->loading()), stress = grade_.stress * progress_.watch.last;
    request_.progress({strain / request_.options.loading.until,
                       fmt::format("strain {:.2f} %, stress {}, {} steps/s", 100.0 * strain,
                                   io::quantity(stress, io::Dimension::stress), io::count(rate)),
                       strain, stress});
  }

  /// Engineering strain; beyond the end where none is due.
  double next_frame() const {
    return next_frame_ < frame_strains_.size() ? frame_strains_[next_frame_] - results::strain_rounding
                                               : std::numeric_limits<double>::infinity();
  }

  results::Frame frame_now() const {
    results::Frame frame = take_frame(*simulation_, original_bonds_);
    add_forces(frame, *simulation_, request_.options, request_.mean_diameter);
    grade_.apply(frame);
    return frame;
  }

  void keep_due_frame() {
    while (next_frame() <= simulation_->strain()) ++next_frame_;
    keep_frame(frame_now());
  }

  void keep_frame(const results::Frame& frame) {
    results::write_frame(folder_.frame_file(simulation_->steps()), frame);
    progress_.frame_strains.push_back(frame.info.strain);
    progress_.frame_steps.push_back(simulation_->steps());
  }

  bool wants_peak_frame() const { return wants_frames() && request_.options.output.frame_strains.empty(); }

  /// The peak is known only when it is behind: its frame is kept aside whenever the stress is the largest so far.
  void write_peak_frame() {
    if (peak_frame_) results::write_frame(folder_.frame_file(progress_.peak_frame_step), *peak_frame_);
    peak_frame_.reset();
  }

  /// By rising strain, that of the peak among them once it is known. One that cannot be read any more is left out with
  /// a warning: the run is worth more than one of its frames.
  std::vector<std::filesystem::path> frame_files() {
    write_peak_frame();
    std::vector<double> strains = progress_.frame_strains;
    std::vector<std::int64_t> steps = progress_.frame_steps;
    if (simulation_->peak_frozen() && progress_.peak_frame_step > 0) {
      const auto place = std::upper_bound(strains.begin(), strains.end(), progress_.peak_frame_strain);
      steps.insert(steps.begin() + (place - strains.begin()), progress_.peak_frame_step);
    }
    std::vector<std::filesystem::path> files;
    for (const std::int64_t step : steps) {
      const std::string problem = folder_.frame_problem(step, simulation_->discs().size());
      if (problem.empty())
        files.push_back(folder_.frame_file(step));
      else
        io::log_warning(fmt::format("a frame is lost: {}; the run is written without it", problem));
    }
    return files;
  }

  /// Of the samples since the last call; false: the run has failed.
  bool energies_close() {
    const double residual = energies_.residual(progress_.history);
    if (residual <= largest_residual) return true;
    response_.summary.status = results::RunStatus::failed;
    response_.summary.reason = fmt::format(
        "energy residual {} at strain {:.4f}: the step is too long or the block is loaded too fast; lower "
        "dynamics.step_factor, or loading.rate where it is set",
        io::quantity(residual, io::Dimension::ratio), simulation_->strain());
    return false;
  }

  bool failed() {
    const double overlap = simulation_->largest_overlap() / request_.mean_diameter;
    if (std::isfinite(simulation_->loading().segment_stress) &&
        std::isfinite(simulation_->kinetic_energy_at_half_step()) && overlap < unstable_overlap)
      return false;
    response_.summary.status = results::RunStatus::failed;
    response_.summary.reason =
        fmt::format("unstable step: largest overlap {:.3g} <d> at strain {:.4f}", overlap, simulation_->strain());
    return true;
  }

  void finish() {
    results::Summary& s = response_.summary;
    results::History h = progress_.history;
    grade_.apply(h);
    const double peak_stress = grade_.stress * simulation_->peak_stress();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    s.steps = simulation_->steps();
    s.final_strain = simulation_->strain();
    results::measure_rate(h, s);
    s.first_peak_stress = simulation_->peak_frozen() ? peak_stress : nan;
    s.first_peak_strain = simulation_->peak_frozen() ? simulation_->peak_strain() : nan;
    s.impact_stress_per_rate = grade_.rate * setup_.plan.stress_per_rate;
    results::MeasuringFrame frame = request_.measuring;
    frame.reference_area = request_.layout->width * request_.layout->height;
    results::measure_curve(h, frame, s);
    s.broken_bonds = static_cast<std::int64_t>(simulation_->events().size());
    s.broken_in_tension = samples_->broken_in_tension(*simulation_);
    s.broken_in_shear = s.broken_bonds - s.broken_in_tension;
    const Fragments& fragments = samples_->fragments(*simulation_);
    s.fragments = fragments.count;
    s.largest_fragment_fraction = fragments.largest_fraction;
    s.max_overlap_in_run = simulation_->largest_overlap() / request_.mean_diameter;
    s.energy_residual = results::energy_residual(h, results::residual_from_strain);
    s.stress_asymmetry =
        simulation_->peak_stress() > 0.0 ? simulation_->largest_asymmetry() / simulation_->peak_stress() : nan;
    const double modulus = results::loading_modulus(h, peak_stress, simulation_->peak_strain());
    const double wave_speed = std::sqrt(modulus / setup_.loading.bulk_density);
    const double peak_time = grade_.time * simulation_->peak_time();
    s.transits_before_peak = simulation_->peak_frozen() ? peak_time * wave_speed / request_.layout->height : nan;
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
    response_.history = std::move(h);
    if (!writes()) return;
    results::write_run(request_.run_file, record(), frame_files(), request_.periodic);
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
    run.history = response_.history;
    run.events = simulation_->events();
    for (results::BreakEvent& event : run.events) grade_.apply(event);
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
  results::GradeChange grade_;
  RunSetup setup_;
  RunFolder folder_;
  std::vector<std::int32_t> original_bonds_;
  std::vector<double> frame_strains_;
  std::size_t next_frame_ = 0;
  std::optional<Simulation> simulation_;
  RunProgress progress_;
  std::optional<Samples> samples_;
  EnergyWatch energies_;
  ThreadChoice thread_choice_;
  Response response_;
  std::optional<results::Frame> peak_frame_;  // at the largest mean stress of a segment so far
  Clock::time_point started_, last_checkpoint_;
  std::int64_t first_step_ = 0;
  double first_bond_steps_ = 0.0;
  double earlier_seconds_ = 0.0;
};

}  // namespace

Response run_compression(const RunRequest& request) {
  RunRequest similar = request;
  similar.options = at_grade_one(request.options);
  return Run(similar, request.options.material.grade).execute();
}

}  // namespace perfora::solver
