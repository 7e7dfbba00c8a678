// What is here: discs and bonds at every frame and the broken bonds as CSV, one line of names, SI, a row a disc, bond
// or break. What is not: the history (R.csv, which stands beside the run file already).
#include <fmt/format.h>

#include <iterator>

#include "io/files.h"
#include "report/export/registry.h"

namespace perfora::report {
namespace {

void write(const std::filesystem::path& base, const char* extension, const fmt::memory_buffer& out) {
  io::write_file(with_extension(base, extension), {out.data(), out.size()});
}

void add_names(fmt::memory_buffer& out, const char* first, const std::vector<Column>& columns) {
  fmt::format_to(std::back_inserter(out), "frame,strain,time,{}", first);
  for (const Column& column : columns) fmt::format_to(std::back_inserter(out), ",{}", column.name);
  out.push_back('\n');
}

void add_discs(fmt::memory_buffer& out, std::size_t number, const Moment& moment) {
  for (std::size_t d = 0; d < moment.position.size() / 2; ++d) {
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{}", number, moment.info.strain, moment.info.time, d,
                   moment.position[2 * d], moment.position[2 * d + 1]);
    for (const Column& column : moment.columns) add_value(out, ',', column, d);
    out.push_back('\n');
  }
}

void add_pairs(fmt::memory_buffer& out, std::size_t number, const results::FrameInfo& info,
               const std::vector<std::int32_t>& pairs, const std::vector<Column>& columns) {
  for (std::size_t k = 0; k < pairs.size() / 2; ++k) {
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{}", number, info.strain, info.time, pairs[2 * k],
                   pairs[2 * k + 1]);
    for (const Column& column : columns) add_value(out, ',', column, k);
    out.push_back('\n');
  }
}

}  // namespace

void write_csv(const Scene& scene, const std::filesystem::path& base) {
  require_frames(scene, "a table of discs");
  fmt::memory_buffer discs, bonds, contacts, breaks;
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const Moment moment = scene.moment(k);
    if (k == 0) {
      add_names(discs, "disc,x,y", moment.columns);
      add_names(bonds, "i,j", moment.bond_columns);
      add_names(contacts, "i,j", moment.contact_columns);
    }
    add_discs(discs, scene.number(k), moment);
    add_pairs(bonds, scene.number(k), moment.info, moment.pairs, moment.bond_columns);
    add_pairs(contacts, scene.number(k), moment.info, moment.contacts, moment.contact_columns);
  }
  fmt::format_to(std::back_inserter(breaks), "time,strain,bond,i,j,x,y,mode,energy\n");
  for (const results::BreakEvent& event : scene.events())
    fmt::format_to(std::back_inserter(breaks), "{},{},{},{},{},{},{},{},{}\n", event.time, event.strain, event.bond,
                   event.i, event.j, event.x, event.y, event.mode == results::BreakMode::tension ? "tension" : "shear",
                   event.energy);
  write(base, ".discs.csv", discs);
  write(base, ".bonds.csv", bonds);
  write(base, ".contacts.csv", contacts);
  write(base, ".breaks.csv", breaks);
}

}  // namespace perfora::report
