// What is here: whole result files read for users of the library. What is not: the formats (results/).
#include "perfora/files.h"

#include <algorithm>

#include "perfora/inside.h"
#include "results/elastic_file.h"
#include "results/material_file.h"
#include "results/run_file.h"

namespace perfora {

namespace {

namespace fs = std::filesystem;

Column column(const char* name, const char* unit, std::vector<double> values) {
  return {name, unit, std::move(values), {}};
}

/// A number of each event as a column.
template <class Number>
Column event_column(const std::vector<results::BreakEvent>& events, const char* name, const char* unit,
                    Number results::BreakEvent::*member) {
  std::vector<double> values;
  values.reserve(events.size());
  for (const results::BreakEvent& event : events) values.push_back(static_cast<double>(event.*member));
  return column(name, unit, std::move(values));
}

Table table_of(const std::vector<results::BreakEvent>& events) {
  using results::BreakEvent;
  Table table;
  table.columns = {event_column(events, "time", "s", &BreakEvent::time),
                   event_column(events, "strain", "", &BreakEvent::strain),
                   event_column(events, "bond", "", &BreakEvent::bond),
                   event_column(events, "i", "", &BreakEvent::i),
                   event_column(events, "j", "", &BreakEvent::j),
                   event_column(events, "x", "m", &BreakEvent::x),
                   event_column(events, "y", "m", &BreakEvent::y),
                   event_column(events, "mode", "", &BreakEvent::mode),
                   event_column(events, "energy", "J/m", &BreakEvent::energy)};
  return table;
}

/// Column `place` of rows of two.
std::vector<double> one_of_pairs(const std::vector<std::int32_t>& pairs, std::size_t place) {
  std::vector<double> values;
  for (std::size_t k = place; k < pairs.size(); k += 2) values.push_back(pairs[k]);
  return values;
}

Table table_of(const results::FirstBonds& bonds) {
  Table table;
  table.columns = {column("x", "m", bonds.x),
                   column("y", "m", bonds.y),
                   column("strain", "", bonds.strain),
                   column("i", "", one_of_pairs(bonds.pairs, 0)),
                   column("j", "", one_of_pairs(bonds.pairs, 1)),
                   column("mode", "", {bonds.mode.begin(), bonds.mode.end()})};
  return table;
}

Table table_of(const results::MaterialCurve& curve) {
  Table table;
  table.columns = {column("strain", "", curve.strain),
                   column("stress", "Pa", curve.stress),
                   column("lateral_strain", "", curve.lateral_strain),
                   column("lateral_stress", "Pa", curve.lateral_stress),
                   column("damage", "J/m", curve.damage),
                   column("work", "J/m", curve.work),
                   column("cundall", "J/m", curve.cundall),
                   column("broken_bonds", "", curve.broken_bonds)};
  return table;
}

std::array<double, 9> matrix_of(const std::vector<double>& values) {
  std::array<double, 9> matrix{};
  std::copy_n(values.begin(), std::min(values.size(), matrix.size()), matrix.begin());
  return matrix;
}

}  // namespace

struct RunFile::Content {
  results::RunResult file;
  Run run;
  Discs discs;
  std::vector<Outline> openings;
  Bonds bonds;
  Table events;
};

RunFile::RunFile(const fs::path& file)
    : content_(at_boundary([&] {
        auto content = std::make_shared<Content>();
        content->file = results::read_run(file);
        content->run = public_run(content->file);
        content->discs = discs_of(content->file.clipped);
        content->openings = outlines_of(content->file.layout);
        results::Bonds& bonds = content->file.bonds;
        content->bonds = {std::move(bonds.pairs), std::move(bonds.reference_length), std::move(bonds.strength_factor)};
        content->events = table_of(content->file.events);
        return content;
      })) {}

const Run& RunFile::run() const {
  return content_->run;
}

const Discs& RunFile::discs() const {
  return content_->discs;
}

const std::vector<Outline>& RunFile::openings() const {
  return content_->openings;
}

const Bonds& RunFile::bonds() const {
  return content_->bonds;
}

const Table& RunFile::events() const {
  return content_->events;
}

std::size_t RunFile::frames() const {
  return content_->file.frames.size();
}

Frame RunFile::frame(std::size_t index) const {
  return at_boundary([&] {
    if (index >= frames())
      throw io::InputError({content_->file.path.string(), 0, ""}, "has no frame " + std::to_string(index),
                           "it has " + std::to_string(frames()) + ", numbered from 0");
    results::Frame read = results::read_frame(content_->file, index);
    Frame frame;
    frame.strain = read.info.strain;
    frame.time = read.info.time;
    frame.width = read.info.h_xx;
    frame.height = read.info.h_yy;
    frame.shear = read.info.h_xy;
    frame.position = std::move(read.position);
    frame.angle = std::move(read.angle);
    frame.fragment = std::move(read.fragment);
    frame.damage = std::move(read.damage);
    frame.bonds = std::move(read.bond_pairs);
    frame.bond_damage = std::move(read.bond_damage);
    frame.velocity = std::move(read.velocity);
    frame.spin = std::move(read.spin);
    frame.stress = std::move(read.stress);
    frame.bond_normal_force = std::move(read.bond_normal_force);
    frame.bond_shear_force = std::move(read.bond_shear_force);
    frame.contacts = std::move(read.contact_pairs);
    frame.contact_normal_force = std::move(read.contact_normal_force);
    frame.contact_shear_force = std::move(read.contact_shear_force);
    return frame;
  });
}

ElasticResponse read_elastic(const fs::path& file) {
  return at_boundary([&] {
    results::ElasticResult read = results::read_elastic(file);
    ElasticResponse response;
    response.stiffness = matrix_of(read.stiffness);
    response.affine_stiffness = matrix_of(read.affine_stiffness);
    response.discs = discs_of(read.clipped);
    response.openings = outlines_of(read.layout);
    response.displacement = std::move(read.displacement);
    response.disc_strain = std::move(read.disc_strain);
    response.first_bonds = table_of(read.first_bonds);
    response.design = read.provenance.config;
    response.record = read.summary.dump(2);
    return response;
  });
}

MaterialTests read_material_tests(const fs::path& file) {
  return at_boundary([&] {
    const results::MaterialResult read = results::read_material_tests(file);
    MaterialTests tests;
    for (const results::MaterialTest& one : read.tests)
      tests.tests.push_back({one.name, one.replicate, table_of(one.curve)});
    tests.sample = discs_of(read.sample);
    tests.design = read.provenance.config;
    tests.record = read.summary.dump(2);
    return tests;
  });
}

}  // namespace perfora
