// What is here: names of the formats of files, and of records that several rooms name (docs/user/formats.md). What is
// not: what they hold, records that one file alone names.
#pragma once

namespace perfora::results {

// HDF5, attribute `format`.
inline constexpr const char* run_format = "perfora.run/1";
inline constexpr const char* pack_format = "perfora.pack/1";
inline constexpr const char* material_format = "perfora.test/1";
inline constexpr const char* elastic_format = "perfora.elastic/1";
inline constexpr const char* history_format = "perfora.history/1";
inline constexpr const char* checkpoint_format = "perfora.checkpoint/5";
// JSON, key `schema`; packings, material tests and elastic responses have the names of their files.
inline constexpr const char* evaluation_schema = "perfora.evaluate/1";
inline constexpr const char* ensemble_schema = "perfora.ensemble/1";
inline constexpr const char* sweep_schema = "perfora.sweep/1";
inline constexpr const char* tolerance_schema = "perfora.tolerance/1";
inline constexpr const char* study_schema = "perfora.optimize/1";
inline constexpr const char* map_schema = "perfora.map/1";
inline constexpr const char* calibration_schema = "perfora.calibrate/1";
inline constexpr const char* check_schema = "perfora.check/1";

}  // namespace perfora::results
