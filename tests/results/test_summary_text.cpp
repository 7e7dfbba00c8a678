// What is here: what the summary of each schema says, and that no damaged object crashes it. Expected texts: written
// out by hand. What is not: how numbers read (tests/io/test_text.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "results/summary_text.h"
#include "tests/io/io_support.h"

namespace perfora::results {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

io::Dimension dimension_of_key(const std::string& key) {
  if (key == "layout.diameter") return io::Dimension::length;
  return key == "material.normal_stiffness" ? io::Dimension::stiffness : io::Dimension::none;
}

std::string text_of(const json& object) {
  return summary_text(object, dimension_of_key, "a.json");
}

const json evaluation = json::parse(R"({"schema": "perfora.evaluate/1", "status": "stopped", "reason": "signal",
  "seeds": {"packing": 12345678901234}, "perforations": 4, "thinnest_wall": 0.005, "thinnest_wall_pair": [0, 1],
  "mean_diameter": 0.0005044, "plateau_stress": null, "first_peak_stress": 653400.0, "first_peak_strain": 0.01,
  "plateau_window": [0.2, 0.4], "energy_absorbed": 9701.2, "time_step": 1.282e-6, "broken_bonds": 61234,
  "performance": {"seconds": 9.8, "threads": 2, "steps_per_second": 12345.6, "ns_per_bond_step": 5.31,
  "peak_memory": 2.48e7}})");

const json ensemble = json::parse(R"({"schema": "perfora.ensemble/1", "status": "completed", "reason": "all runs done",
  "statistics": {"plateau_stress": {"count": 4, "mean": 5294.0, "standard_deviation": 312.0, "confidence_95": null,
  "minimum": 4900.0, "maximum": 5600.0}}})");

const json sweep = json::parse(R"({"schema": "perfora.sweep/1", "status": "completed", "reason": "",
  "measures": ["plateau_stress", "densification_strain"], "performance": {"seconds": 70.0, "simulated_seconds": 7620.0},
  "cases": [
  {"case": 0, "label": "the design itself", "problem": null, "completed": 2, "failed": 0, "statistics":
   {"plateau_stress": {"mean": 5000.0, "confidence_95": 250.0}, "densification_strain": {"mean": 0.5}}},
  {"case": 1, "label": "diameter 18 mm", "problem": null, "completed": 1, "failed": 1, "statistics":
   {"plateau_stress": {"mean": 6000.0, "confidence_95": null}}, "changes": {"plateau_stress": {"mean": 1000.0}}},
  {"case": 2, "label": "diameter 30 mm", "problem": "holes touch", "completed": 0, "failed": 0, "statistics": {}}]})");

const json study = json::parse(R"({"schema": "perfora.optimize/1", "status": "completed", "reason": "maxeval",
  "score": 0.003832, "target": 200000.0, "evaluations": 24, "stop_reason": "maxeval",
  "best": {"layout.family": "square", "layout.diameter": 0.016333, "layout.rows": 6},
  "finals": {"pairs": 5, "best": {"mean": 216400.0, "standard_deviation": 33620.0}, "start": {"mean": 21010.0},
  "gain": 1.25, "gain_standard_error": 0.1, "significant": true}})");

const json calibration = json::parse(R"({"schema": "perfora.calibrate/1", "status": "completed", "reason": "met",
  "found": {"normal_stiffness": 2.195e7, "rupture_delay": null}, "targets": [
  {"name": "young_modulus", "wanted": 2.5e10, "reached": 2.4e10, "met": true},
  {"name": "poisson_ratio", "wanted": 0.2, "reached": null, "met": false}]})");

const json material = json::parse(R"({"schema": "perfora.test/1", "status": "completed", "reason": "",
  "material": {"tensile_strength": {"count": 8, "mean": 3.1e6, "standard_deviation": 1e5},
  "fracture_energy": {"count": 1, "mean": 58.3, "standard_deviation": null}}})");

const json elastic = json::parse(R"({"schema": "perfora.elastic/1", "status": "completed", "reason": "", "young_x": 9e7,
  "stiffness": [[1.008e8, 2e6, 0.0], [2e6, null, 0.0], [0.0, 0.0, 3.5e7]], "first_yield_strain": 0.001454,
  "first_yield_place": [0.07299, 0.03541], "first_yield_mode": "tension", "iterations": 60})");

const json check = json::parse(R"({"schema": "perfora.check/1", "status": "completed", "reason": "", "kind": "design",
  "perforations": 0, "thinnest_wall": null, "discs": 36607, "memory": 4.69e7, "seconds": 7620.0, "threads": 1})");

TEST(SummaryText, Evaluation) {
  EXPECT_THAT(text_of(evaluation),
              AllOf(HasSubstr("stopped: signal\n"), ContainsRegex("seeds +packing 12345678901234"),
                    ContainsRegex("thinnest wall +5 mm\n.*between holes +1 and 2\n"),
                    ContainsRegex("mean diameter +504.4 um"), ContainsRegex("first peak stress +653.4 kPa"),
                    ContainsRegex("first peak strain +1 %"), ContainsRegex("plateau stress +not reached"),
                    ContainsRegex("plateau window +20 to 40 % strain"), ContainsRegex("energy absorbed.* 9.701 kJ/m3"),
                    ContainsRegex("time step +1.282 us"), ContainsRegex("broken bonds +61,234")));
  EXPECT_THAT(text_of(evaluation),
              AllOf(ContainsRegex("time +9.8 s on 2 threads"), ContainsRegex("steps per second +12,350"),
                    HasSubstr("5.31 ns"), ContainsRegex("largest memory +24.8 MB")));
  json solid = evaluation;
  solid["thinnest_wall"] = nullptr;
  EXPECT_THAT(text_of(solid), Not(HasSubstr("thinnest wall "))) << "there is none to speak of";
}

TEST(SummaryText, Tables) {
  EXPECT_THAT(text_of(ensemble), ContainsRegex("plateau_stress +5.294 kPa +- +312 Pa +4.9 kPa +5.6 kPa +4\n"));
  json wished = ensemble;
  wished["single_blocks"] = {{"text", "4 of 5 single blocks keep every wish"}};
  EXPECT_THAT(text_of(wished), HasSubstr("Single blocks\n  4 of 5 single blocks keep every wish\n"));
  json judged = sweep;
  judged["cases"][1]["single_blocks"] = wished.at("single_blocks");
  EXPECT_THAT(text_of(judged), HasSubstr("\ncase 1: 4 of 5 single blocks keep every wish\n"));
  EXPECT_THAT(
      text_of(sweep),
      AllOf(ContainsRegex("0  the design itself +2 +5 \\+- 0.25 kPa +50 %\n"),
            ContainsRegex("1  diameter 18 mm +1 +6 kPa \\(\\+20 %\\) +-  1 failed\n"),
            ContainsRegex("2  diameter 30 mm +cannot be run\n"), HasSubstr("the change to case 0"),
            ContainsRegex("time of the last call +1 min 10 s"), ContainsRegex("sum of all simulations +2 h 07 min")));
  EXPECT_THAT(
      text_of(calibration),
      AllOf(ContainsRegex("material.normal_stiffness +21.95 MN/m"), ContainsRegex("rupture_delay +none"),
            ContainsRegex("young_modulus +25 GPa +24 GPa +met"), ContainsRegex("poisson_ratio +0.2 +- +NOT MET")));
  EXPECT_THAT(text_of(elastic),
              AllOf(HasSubstr("Stiffness (MPa)"), ContainsRegex(" 100.8 +2 +0\n"), ContainsRegex(" 2 +- +0\n"),
                    ContainsRegex("place of the first bond .* 72.99, 35.41 mm"), ContainsRegex("yields in +tension")));
}

// Where efficiency still grows at the end of a run, its largest value is not that one.
TEST(SummaryText, AnOnsetAtTheEndIsNone) {
  json runs = ensemble;
  runs["statistics"]["final_strain"] = {{"count", 4}, {"mean", 0.6}, {"confidence_95", 0.0}};
  json& onset = runs["statistics"]["densification_onset"];
  onset = {{"count", 4}, {"mean", 0.52}, {"confidence_95", 0.1}, {"minimum", 0.41}, {"maximum", 0.598}};
  EXPECT_THAT(text_of(runs), ContainsRegex("densification_onset +52 % +10 % +- +41 % +not reached +4\n"));
  onset["mean"] = 0.599;
  EXPECT_THAT(text_of(runs), ContainsRegex("densification_onset +not reached +10 %"));
  json cases = sweep;
  cases["measures"] = {"densification_onset"};
  cases["cases"][0]["statistics"] = {{"densification_onset", {{"mean", 0.599}, {"confidence_95", 0.01}}},
                                     {"final_strain", {{"mean", 0.6}}}};
  EXPECT_THAT(text_of(cases), ContainsRegex("the design itself +2 +not reached\n"));
}

TEST(SummaryText, StudyMaterialCheck) {
  EXPECT_THAT(
      text_of(study),
      AllOf(ContainsRegex("target +200 kPa"), ContainsRegex("layout.diameter +16.33 mm"),
            ContainsRegex("layout.family +square"), ContainsRegex("layout.rows +6\n"), HasSubstr("On 5 fresh seeds"),
            ContainsRegex("plateau of the best +216.4 kPa \\(deviation 33.62 kPa\\)"),
            ContainsRegex("plateau of the start +21.01 kPa\n"),
            ContainsRegex("gain .* 1.25 \\+- 0.1 \\(standard error\\)"), HasSubstr("  more than two standard errors")));
  EXPECT_THAT(text_of(material), AllOf(ContainsRegex("tensile strength +3.1 MPa \\(deviation 100 kPa, 8 samples\\)"),
                                       ContainsRegex("fracture energy +58.3 J/m2\n")));
  EXPECT_THAT(text_of(check), AllOf(ContainsRegex("discs +36,607"), ContainsRegex("memory +46.9 MB"),
                                    HasSubstr("2 h 07 min on 1 thread\n"), Not(HasSubstr("thinnest"))));
}

TEST(SummaryText, RefusesOtherObjects) {
  EXPECT_THAT(io::input_error([] { text_of(json::array()); }), HasSubstr("a.json: holds no result"));
  EXPECT_THAT(io::input_error([] { text_of({{"schema", "perfora.plot/1"}}); }), HasSubstr("\"perfora.plot/1\""));
  EXPECT_THAT(io::input_error([] {
                text_of({{"schema", "perfora.sweep/1"}});
              }),
              HasSubstr("a.json: is damaged: its key `cases` is missing"));
  EXPECT_THAT(io::input_error([] {
                text_of({{"schema", "perfora.test/1"}, {"material", 1}});
              }),
              HasSubstr("`material` is no object"));
}

/// Every value within `object`, by its path.
void add_places(const json& value, const json::json_pointer& place, std::vector<json::json_pointer>& places) {
  places.push_back(place);
  if (value.is_object())
    for (const auto& [key, item] : value.items()) add_places(item, place / key, places);
  if (value.is_array())
    for (std::size_t k = 0; k < value.size(); ++k) add_places(value[k], place / k, places);
}

TEST(SummaryText, NoDamageCrashes) {
  const std::vector<json> values = {nullptr, true,           -1,         1e300,          "text\n", json::array(),
                                    {1, 2},  json::object(), {{"a", 1}}, {json::array()}};
  int shown = 0, refused = 0;
  for (const json& object : {evaluation, ensemble, sweep, study, calibration, material, elastic, check}) {
    std::vector<json::json_pointer> places;
    add_places(object, json::json_pointer(), places);
    for (const json::json_pointer& place : places)
      for (const json& value : values) {
        json damaged = object;
        damaged[place] = value;
        try {
          EXPECT_FALSE(text_of(damaged).empty());
          ++shown;
        } catch (const io::InputError& error) {
          EXPECT_THAT(error.what(), HasSubstr("a.json: "));
          ++refused;
        }
      }
  }
  EXPECT_GT(shown, 500);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace perfora::results
