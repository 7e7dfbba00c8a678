// What is here: tests of the HTML report: its encodings against published and independent ones, what a user wrote kept
// out of the markup, size, the facts of every kind of work. What is not: how it looks and moves (tests/viewers).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <numbers>

#include "io/error.h"
#include "io/files.h"
#include "io/journal.h"
#include "report/html/disc_pressure.h"
#include "report/html/layout_path.h"
#include "report/html/packed.h"
#include "report/html/page.h"
#include "report/html/run_part.h"
#include "report/html_report.h"
#include "report/sweep_picture.h"
#include "results/map_record.h"
#include "results/measure_table.h"
#include "results/sampled_curve.h"
#include "tests/results/synthetic_run.h"

namespace perfora::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using results::testing::fresh_folder;
using results::testing::make_run;
using results::testing::SyntheticRun;
using results::testing::write_run;
using ::testing::HasSubstr;
using ::testing::Not;

/// Base64 read back by the rule of RFC 4648.
std::string from_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t value = letters.find(c);
    if (value == std::string::npos) break;
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) bytes += static_cast<char>((bits >> (count -= 8)) & 255u);
  }
  return bytes;
}

std::string unpacked(const std::string& text, std::size_t length) {
  const std::string bytes = from_base64(text);
  std::string result(length, '\0');
  uLongf size = length;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                       static_cast<uLong>(bytes.size())),
            Z_OK);
  EXPECT_EQ(size, length);
  return result;
}

/// The text of the script element `id` of a page.
std::string script_of(const std::string& page, const std::string& id) {
  const std::size_t at = page.find("id=\"" + id + "\">"), begin = page.find('>', at) + 1;
  EXPECT_NE(at, std::string::npos) << id;
  return at == std::string::npos ? "" : page.substr(begin, page.find("</script>", begin) - begin);
}

json facts_of(const std::string& page) {
  return json::parse(script_of(page, "facts"));
}

// RFC 4648, section 10.
TEST(Base64, GivesThePublishedTexts) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
}

TEST(Packed, ZlibReadsItBack) {
  std::string bytes;
  for (int k = 0; k < 5000; ++k) bytes += static_cast<char>(k * k % 251);
  EXPECT_EQ(unpacked(packed(bytes), bytes.size()), bytes);
}

TEST(Steps, AreOffByHalfAStepAtMost) {
  std::vector<double> values;
  for (int k = 0; k <= 1000; ++k) values.push_back(-0.3 + 0.45 * std::sin(0.7 * k));
  const Steps steps = in_steps(values, -0.75, 0.15);
  EXPECT_DOUBLE_EQ(steps.step, 0.9 / 65535.0);
  for (std::size_t k = 0; k < values.size(); ++k)
    EXPECT_NEAR(steps.offset + steps.step * steps.codes[k], values[k], 0.5 * steps.step * (1.0 + 1e-9));
  EXPECT_EQ(in_steps(std::vector<double>{-9.0, 9.0, NAN}, 0.0, 1.0).codes, (std::vector<std::uint16_t>{0, 65535, 0}));
  EXPECT_EQ(in_steps(std::vector<double>{2.0}, 2.0, 2.0).codes, std::vector<std::uint16_t>{0});
}

// Read back as data.js does: low bytes, high bytes, then sums modulo 65,536.
TEST(Differences, SumUpToTheCodes) {
  std::vector<std::uint16_t> codes;
  for (int k = 0; k < 999; ++k) codes.push_back(static_cast<std::uint16_t>(k * 7919));
  const std::string bytes = differences(codes, 111);
  ASSERT_EQ(bytes.size(), 2 * codes.size());
  std::vector<std::uint16_t> read(codes.size());
  for (std::size_t k = 0; k < codes.size(); ++k) {
    const auto low = static_cast<std::uint8_t>(bytes[k]), high = static_cast<std::uint8_t>(bytes[codes.size() + k]);
    read[k] = static_cast<std::uint16_t>((low | (high << 8)) + (k >= 111 ? read[k - 111] : 0));
  }
  EXPECT_EQ(read, codes);
}

TEST(Page, WhatAUserWroteIsNoMarkup) {
  Part part;
  const std::string nasty = "</script><script>alert(1)</script><!-- \"&' <img src=x onerror=alert(2)>";
  part.facts = {{"title", nasty}, {"command", nasty}};
  const std::string page = html_page(part);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, HasSubstr("<title>&lt;/script&gt;&lt;script&gt;alert(1)"));
  EXPECT_EQ(facts_of(page).at("command"), nasty);
}

TEST(Page, TakesTextThatIsNoUtf8) {
  Part part;
  part.facts = {{"title", "M\xfcller"}};
  EXPECT_NO_THROW(facts_of(html_page(part)));
}

// Nothing is fetched: no address but names of licences and of XML within the libraries, and a policy that forbids it.
TEST(Page, NeedsNothingFromOutside) {
  const std::string page = html_page({});
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  for (const char* fetching : {"src=\"", "<link", "@import", "url(", "fetch(", "XMLHttpRequest", "import("})
    EXPECT_THAT(page, Not(HasSubstr(fetching))) << fetching;
  for (const char* part : {"{{", "undefined-place"}) EXPECT_THAT(page.substr(0, 2000), Not(HasSubstr(part)));
  EXPECT_THAT(page, HasSubstr("Chart.js v"));
}

TEST(Report, OfARunHoldsItsNumbers) {
  const auto folder = fresh_folder("report-run");
  const SyntheticRun synthetic = make_run(0.05, 2, 1e-3, 0.6);
  write_run(synthetic, folder / "R.h5");
  write_report(folder / "R.h5", folder / "R.html", {.title = "My <block>"});
  const std::string page = io::read_file(folder / "R.html");
  EXPECT_LT(page.size(), most_report_bytes);
  const json facts = facts_of(page);
  EXPECT_EQ(facts.at("title"), "My <block>");
  EXPECT_EQ(facts.at("kind"), "run");
  const json& run = facts.at("run");
  // The curve, as 32-bit floats.
  const std::size_t rows = synthetic.run.history.rows(), columns = run.at("history").at("columns").size();
  ASSERT_EQ(run.at("history").at("rows"), rows);
  const std::string bytes = unpacked(script_of(page, "numbers-history"), 4 * rows * columns);
  float strain = 0.0f;
  std::memcpy(&strain, bytes.data() + 4 * (rows - 1), sizeof strain);
  EXPECT_FLOAT_EQ(strain, 0.6f);
  // A disc of the last frame, within half a step of 16 bits.
  const json& frames = run.at("frames");
  const std::size_t discs = frames.at("discs"), count = frames.at("list").size();
  ASSERT_EQ(count, synthetic.frames.size());
  const std::string codes = unpacked(script_of(page, "numbers-x"), 2 * discs * count);
  std::uint16_t code = 0;
  const std::size_t disc = discs / 2;
  for (std::size_t k = disc; k < discs * count; k += discs)
    code = static_cast<std::uint16_t>(
        code + (static_cast<std::uint8_t>(codes[k]) | (static_cast<std::uint8_t>(codes[discs * count + k]) << 8)));
  const double step = frames.at("x").at(1);
  EXPECT_NEAR(frames.at("x").at(0).get<double>() + step * code, synthetic.frames.back().position[2 * disc],
              0.51 * step);
}

TEST(Report, LeavesFramesOutToStaySmall) {
  const SyntheticRun synthetic = make_run(0.05, 2, 1e-3, 0.6);
  const auto folder = fresh_folder("report-small");
  write_run(synthetic, folder / "R.h5");
  const results::RunResult run = results::read_run(folder / "R.h5");
  Part whole, small;
  add_frames(run, 10'000'000, whole);
  add_frames(run, 20'000, small);
  EXPECT_EQ(whole.facts.at("frames").at("list").size(), run.frames.size());
  EXPECT_LT(small.facts.at("frames").at("list").size(), run.frames.size());
  EXPECT_EQ(small.facts.at("frames").at("of"), run.frames.size());
  // The first and the last stay.
  EXPECT_EQ(small.facts.at("frames").at("list").front().at("strain"), run.frames.front().strain);
  EXPECT_EQ(small.facts.at("frames").at("list").back().at("strain"), run.frames.back().strain);
}

TEST(Report, OfEveryKindOfWork) {
  const auto folder = fresh_folder("report-folders");
  const fs::path data = fs::path(PERFORA_SOURCE_DIR) / "tests" / "pinned" / "data";
  for (const char* kind : {"study", "sweep", "ensemble", "calibration", "study-stopped", "sweep-stopped"}) {
    write_report(data / kind, folder / "r.html");
    const json facts = facts_of(io::read_file(folder / "r.html"));
    EXPECT_TRUE(std::string(kind).starts_with(facts.at("kind").get<std::string>())) << kind;
    EXPECT_FALSE(facts.at("work").empty()) << kind;
  }
  write_report(data / "study", folder / "r.html", {.under_way = true});
  const std::string page = io::read_file(folder / "r.html");
  EXPECT_THAT(page, HasSubstr("http-equiv=\"refresh\""));
  const json work = facts_of(page).at("work");
  EXPECT_EQ(work.at("rows").size(), 9u);  // the start and eight candidates of evaluations.csv
  EXPECT_EQ(work.at("thumbnails").size(), 6u);
  ASSERT_EQ(work.at("failed").size(), 1u);
  EXPECT_EQ(work.at("failed").at(0).at("reason"), "breaks a constraint");
  EXPECT_FALSE(work.at("finals").at("best_scores").empty());
}

TEST(Report, OfOneCaseAndOfAnEnsembleHoldsTheVerdictWithItsWishes) {
  const auto folder = fresh_folder("report-verdict");
  const fs::path data = fs::path(PERFORA_SOURCE_DIR) / "tests" / "pinned" / "data";
  const json verdict = {
      {"outcome", "missed"},
      {"text", "missed: the plateau"},
      {"note", "of the mean"},
      {"wishes", {{{"outcome", "missed"}, {"text", "plateau 2.000 MPa"}, {"measure", "plateau_stress"}}}}};
  const json blocks = {{"text", "1 of 3 single blocks keep every wish"}};
  const auto shown = [&](const fs::path& work) {
    write_report(work, folder / "r.html");
    const json found = facts_of(io::read_file(folder / "r.html")).at("verdict");
    EXPECT_EQ(found.at("outcome"), "missed");
    EXPECT_EQ(found.at("text"), "missed: the plateau");
    EXPECT_EQ(found.at("note"), "of the mean");
    EXPECT_EQ(found.at("blocks"), "1 of 3 single blocks keep every wish");
    ASSERT_EQ(found.at("wishes").size(), 1u);
    EXPECT_EQ(found.at("wishes").at(0).at("text"), "plateau 2.000 MPa");
  };
  fs::copy(data / "sweep-files", folder / "sweep", fs::copy_options::recursive);
  json result = json::parse(io::read_file(folder / "sweep" / "result.json"));
  ASSERT_EQ(result.at("cases").size(), 1u);
  result["cases"][0]["verdict"] = verdict;
  result["cases"][0]["single_blocks"] = blocks;
  io::write_file(folder / "sweep" / "result.json", result.dump());
  shown(folder / "sweep");
  // The picture of the sweep says the same.
  const SweepPicture picture = sweep_picture(results::read_sweep_record(folder / "sweep"));
  EXPECT_EQ(picture.verdict, "missed: the plateau");
  EXPECT_EQ(picture.outcome, "missed");
  // Of two cases each has its own: none stands above them all.
  result["cases"].push_back(result.at("cases").at(0));
  io::write_file(folder / "sweep" / "result.json", result.dump());
  EXPECT_EQ(sweep_picture(results::read_sweep_record(folder / "sweep")).verdict, "");

  fs::copy(data / "ensemble", folder / "ensemble", fs::copy_options::recursive);
  result = json::parse(io::read_file(folder / "ensemble" / "ensemble.json"));
  result["verdict"] = verdict;
  result["single_blocks"] = blocks;
  io::write_file(folder / "ensemble" / "ensemble.json", result.dump());
  shown(folder / "ensemble");
}

TEST(Report, OfAMapHoldsWhatCanBeReachedAndWhatIsWished) {
  const auto folder = fresh_folder("report-map");
  fs::create_directories(folder / "map");
  const results::Measure* plateau = results::measure_called("plateau_stress");
  const results::Measure* porosity = results::measure_called("porosity");
  results::MapRecord record;
  record.title = "Slots <b>";
  record.replicates = 2;
  record.variables = {"layout.diameter"};
  for (int k = 1; k <= 3; ++k) {
    results::MapDesign design;
    design.number = k;
    design.arm = "rows=2";
    design.label = "rows=2, diameter " + std::to_string(k) + " mm";
    design.values = {1e-3 * k};
    design.completed = k < 3 ? 2 : 0;
    design.failed = k < 3 ? 0 : 2;
    design.reason = k < 3 ? "" : "unstable step";
    if (k < 3)
      design.results = {{plateau->key, results::statistic_of({}, {1e5 * k, 1e5 * k})},
                        {porosity->key, results::statistic_of({}, {0.1 * k, 0.1 * k})}};
    record.designs.push_back(design);
  }
  record.wishes = {{plateau, 5e5, 6e5}};
  io::write_file(folder / "map" / "map.json", results::to_json(record).dump());
  io::Journal(folder / "map" / "journal.jsonl").append(json{{"event", "map"}}.dump());
  write_report(folder / "map", folder / "r.html");
  const std::string page = io::read_file(folder / "r.html");
  const json facts = facts_of(page), work = facts.at("work");
  EXPECT_EQ(facts.at("kind"), "map");
  EXPECT_EQ(facts.at("title"), "Slots <b>");
  EXPECT_EQ(page.find("Slots <b>"), std::string::npos) << "text of users is escaped";
  ASSERT_EQ(work.at("rows").size(), 3u);
  EXPECT_EQ(work.at("rows").at(1).at("values"), json({2e-3, 2e5, 0.2}));
  EXPECT_EQ(work.at("rows").at(2).at("status"), "failed");
  EXPECT_EQ(work.at("failed").at(0).at("reason"), "unstable step");
  EXPECT_EQ(work.at("ranges").at(0), json({"plateau stress", "100 to 200 kPa", 2}));
  EXPECT_EQ(work.at("wishes").at(0).at("low"), 5e5);
  ASSERT_EQ(work.at("out_of_reach").size(), 1u);
}

TEST(Report, HasTheTitleOfTheDesign) {
  const auto folder = fresh_folder("report-title");
  SyntheticRun synthetic = make_run(0.05, 2, 1e-3, 0.6);
  synthetic.run.provenance.title = "Slots & holes";
  write_run(synthetic, folder / "R.h5");
  write_report(folder / "R.h5", folder / "R.html");
  const json facts = facts_of(io::read_file(folder / "R.html"));
  EXPECT_EQ(facts.at("title"), "Slots & holes");
  EXPECT_EQ(facts.at("name"), "R");  // of downloads
}

// What result.json says of the model of a search goes into its report as it is.
TEST(Report, OfAStudyWithAModelHasItsSobolIndices) {
  const auto folder = fresh_folder("report-model");
  fs::copy(fs::path(PERFORA_SOURCE_DIR) / "tests" / "pinned" / "data" / "study", folder / "study",
           fs::copy_options::recursive);
  json result = json::parse(io::read_file(folder / "study" / "result.json"));
  const json importance = {{"all", {{"layout.diameter", {{"first", 0.7}, {"total", 0.8}}}}}};
  result["model"] = {{"in_words", "coverage"}, {"trusted", true}, {"importance", importance}};
  io::write_file(folder / "study" / "result.json", result.dump());
  write_report(folder / "study", folder / "r.html");
  EXPECT_EQ(facts_of(io::read_file(folder / "r.html")).at("work").at("model").at("importance"), importance);
}

TEST(Report, RefusesWhatIsNoRun) {
  const auto folder = fresh_folder("report-refused");
  const fs::path data = fs::path(PERFORA_SOURCE_DIR) / "tests" / "pinned" / "data";
  const auto message = [&](const fs::path& input, const fs::path& out) {
    try {
      write_report(input, out);
    } catch (const io::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(data / "pack.h5", folder / "r.html"), HasSubstr("perfora plot"));
  EXPECT_THAT(message(data / "answers", folder / "r.html"), HasSubstr("no study, map, sweep, ensemble or calibration"));
  EXPECT_THAT(message(data / "run.h5", folder / "r.htm"), HasSubstr("report.html"));
  EXPECT_TRUE(fs::is_empty(folder));
}

// Two discs of radius R pressed together by d: f = k d over a branch of 2R - d; each has the mean stress
// f |r| / (4 pi R^2).
TEST(DiscPressure, OfOneContact) {
  results::RunResult run;
  run.width = run.height = 0.1;
  run.edges.platens = run.edges.free = true;
  run.clipped.x = {0.05, 0.0519};
  run.clipped.y = {0.05, 0.05};
  run.clipped.radius = {1e-3, 1e-3};
  results::Frame frame;
  frame.info.h_xx = frame.info.h_yy = 0.1;
  frame.position = {0.05, 0.05, 0.0519, 0.05};
  const double wanted = 2e7 * 1e-4 * 1.9e-3 / (4.0 * std::numbers::pi * 1e-6);
  const std::vector<double> pressure = disc_pressure(run, frame, {.stiffness = 2e7});
  EXPECT_NEAR(pressure[0], wanted, 1e-9 * wanted);
  EXPECT_NEAR(pressure[1], wanted, 1e-9 * wanted);
}

// Averaged over the block by area, the discs carry what the solver measured: half the sum of both normal stresses.
// What is left is the viscous part, and that a row of the history is a mean over some strain.
TEST(DiscPressure, AddsUpToTheStressOfARun) {
  const results::RunResult run =
      results::read_run(fs::path(PERFORA_SOURCE_DIR) / "tests" / "pinned" / "data" / "run.h5");
  const results::Frame frame = results::read_frame(run, run.frames.size() - 1);
  const std::vector<double> pressure = disc_pressure(run, frame, normal_springs(run));
  double sum = 0.0;
  for (std::size_t d = 0; d < pressure.size(); ++d)
    sum += pressure[d] * std::numbers::pi * run.clipped.radius[d] * run.clipped.radius[d];
  const results::History& h = run.history;
  const double wanted = 0.5 * (h.stress_yy.back() + h.stress_xx.back());
  EXPECT_NEAR(sum / (frame.info.h_xx * frame.info.h_yy), wanted, 0.15 * wanted);
}

TEST(LayoutPath, DrawsTheHolesOfAConfiguration) {
  const auto layout = layout_of(
      "[cell]\nwidth = 0.04\nheight = 0.02\n[layout]\nfamily = \"square\"\nrows = 1\n"
      "columns = 2\ndiameter = 0.01\n[material]\ngrade = 2\n",
      1);
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->perforations.size(), 2u);
  const json facts = layout_facts(*layout);
  EXPECT_EQ(facts.at("width"), 40.0);
  // A circle of 5 mm about (10, 10): it begins at its right end.
  EXPECT_THAT(facts.at("path").get<std::string>(), HasSubstr("M15.000 10.000A5.000 5.000 0 0 0 5.000 10.000"));
  EXPECT_FALSE(layout_of("[layout]\nfamily = \"nobody\"\n", 1));
}

}  // namespace
}  // namespace perfora::report
