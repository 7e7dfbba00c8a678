// What is here: one block designed, packed, crushed, and its curve read. What is not: many blocks (sweep.cpp).
#include <perfora/evaluate.h>
#include <perfora/pack.h>

#include <cstdio>

int main() {
  try {
    perfora::Design design;  // every key at its default
    design.set("cell.width", "12 mm").set("cell.height", "12 mm");
    design.set("layout.rows", 1).set("layout.columns", 1).set("layout.diameter", "6 mm");
    design.set("loading.until", "1 %").set("loading.rate", "40 1/s");
    design.set("measures.plateau_start", "0.2 %").set("measures.plateau_end", "0.8 %");
    for (const std::string& warning : design.check()) std::printf("warning: %s\n", warning.c_str());

    const perfora::Packing packing = perfora::pack(design);
    std::printf("%zu discs, porosity %.3f\n", packing.discs.x.size(), packing.measure("porosity"));

    perfora::EvaluateOptions options;
    options.progress = [](const perfora::Progress& progress) {
      std::printf("%3.0f %% done: %s\n", 100.0 * progress.fraction, progress.text.c_str());
      return true;  // false stops the run
    };
    const perfora::Evaluation result = perfora::evaluate(design, options);
    if (result.status != perfora::Status::completed) {
      std::printf("not completed: %s\n", result.reason.c_str());
      return 2;
    }

    const auto strain = result.strain(), stress = result.stress();
    for (std::size_t row = 0; row < strain.size(); ++row)
      std::printf("strain %.4f  stress %8.0f Pa\n", strain[row], stress[row]);
    std::printf("plateau %.0f Pa, %.0f bonds broken\n", result.measure("plateau_stress"),
                result.measure("broken_bonds"));
    return 0;
  } catch (const perfora::Error& error) {  // one sentence: where, what is wrong, what is allowed
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
