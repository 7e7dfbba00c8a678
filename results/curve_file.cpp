// What is here: reading a stress-strain curve from CSV and its checks. What is not: CSV syntax and units (io/csv.h).
#include "results/curve_file.h"

#include <cmath>
#include <string>
#include <utility>

#include "io/csv.h"
#include "io/error.h"
#include "io/text.h"

namespace perfora::results {
namespace {

/// More than any testing machine records in one test.
constexpr std::size_t most_rows = 1'000'000;

std::string strain_text(double strain) {
  return io::quantity(strain, io::Dimension::ratio);
}

}  // namespace

Curve read_curve(const std::filesystem::path& path, StrainOrder order) {
  const std::vector<io::CsvQuantity> columns = {{{"strain", "strain_yy"}, io::Dimension::ratio, "strain [%]"},
                                                {{"stress", "stress_yy"}, io::Dimension::stress, "stress [MPa]"}};
  io::CsvTable table = io::read_csv(path, columns, most_rows);
  Curve curve{std::move(table.columns[0]), std::move(table.columns[1]), path.stem().string()};
  for (std::size_t k = 0; k < curve.strain.size(); ++k) {
    const io::Origin origin{path.string(), table.lines[k], ""};
    if (!(std::abs(curve.strain[k]) < 1.0))
      throw io::InputError(origin, "column strain: " + strain_text(curve.strain[k]) + " is no engineering strain",
                           "strains below 100 %, compression positive, are wanted",
                           "where they are in percent, name the column \"strain [%]\"");
    if (order == StrainOrder::rising && k > 0 && !(curve.strain[k] > curve.strain[k - 1]))
      throw io::InputError(origin,
                           "column strain: " + strain_text(curve.strain[k]) + " is not above the " +
                               strain_text(curve.strain[k - 1]) + " of the row before",
                           "rising strains are wanted", "leave out unloading and repeated rows");
  }
  if (curve.strain.size() < 2)
    throw io::InputError({path.string(), table.lines.front(), ""}, "is the only row of the curve",
                         "at least two rows are wanted", "check the file");
  return curve;
}

}  // namespace perfora::results
