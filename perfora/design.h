// What is here: the design of a block: its keys, their values, its checks; the error that every function of the
// library throws. What is not: what is done with a design (pack.h, evaluate.h, campaign.h).
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/// Perforated concrete blocks that crush at a wanted stress: designs, packings, evaluations, campaigns, results.
/// Numbers are SI; strain is engineering strain, stress in Pa, both positive in compression.
namespace perfora {

/// Something that was given to the library is wrong: a key, a value, a file, a folder. what() is one sentence for
/// people: where, what is wrong, what is allowed, what to do. Numerical trouble is no error but a Status.
class Error : public std::runtime_error {
 public:
  /// An error that says `sentence`.
  explicit Error(const std::string& sentence);
};

/// The surroundings failed, not what was given: a disk that is full, a worker that was lost. Never a result of a
/// design; the same call may succeed later. what() is one sentence that says what to do. Memory that runs out is
/// std::bad_alloc.
class SurroundingsError : public std::runtime_error {
 public:
  /// An error that says `sentence`.
  explicit SurroundingsError(const std::string& sentence);
};

/// What a key of a design holds.
enum class KeyType {
  real,       ///< a number, with its unit where the key has a dimension
  integer,    ///< a whole number
  boolean,    ///< true or false
  text,       ///< any text
  choice,     ///< one of Key::choices
  path,       ///< a file
  real_list,  ///< a list of numbers
  real_rows   ///< a list of rows of numbers
};

/// One key that a design file may set (docs/user/design-files.md).
struct Key {
  std::string name;                  ///< with its section: "layout.diameter"
  KeyType type = KeyType::real;      ///< what it holds
  std::string dimension;             ///< "length", "stress", "ratio", ...; empty: a plain number or no number
  std::string unit;                  ///< of plain numbers, in SI: "m", "Pa"; empty: none
  std::string default_text;          ///< in TOML syntax
  std::string range;                 ///< of the numbers allowed, for people; empty where there are no numbers
  std::vector<std::string> choices;  ///< of KeyType::choice
  std::string help;                  ///< one clause
};

/// Every option of one block and its simulation. Copies are independent. One that was moved from may only be assigned
/// to or destroyed.
class Design {
 public:
  /// All keys at their defaults: the block of the paper's Table 1.
  Design();
  Design(const Design& other);                 ///< An independent copy.
  Design(Design&& other) noexcept;             ///< Takes the values of `other`.
  Design& operator=(const Design& other);      ///< Becomes an independent copy.
  Design& operator=(Design&& other) noexcept;  ///< Takes the values of `other`.
  ~Design();

  /// Reads a design file (TOML), then sets the `overrides`, texts "section.key=value". Throws Error.
  static Design from_file(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
  /// The same of a text, such as to_toml() gives; `name` stands for the file in messages. Throws Error.
  static Design from_toml(const std::string& text, const std::string& name = "text");

  /// Sets a key from a text as `--set` does: "20 mm", "2 MPa", "25 %", "true", "staggered", "[0.1, 0.2]". Throws Error
  /// for an unknown key (the nearest one is named) and a value that the key does not take; the design is then as
  /// before. Returns this design.
  Design& set(const std::string& key, const std::string& value);
  /// Sets a key that holds one number, in SI. Throws Error as above.
  Design& set(const std::string& key, double value);

  /// The value of a key as set() takes it; numbers in SI with as few digits as keep their bits. Throws Error for an
  /// unknown key.
  std::string text(const std::string& key) const;
  /// The value of a key that holds one number, in SI. Throws Error for an unknown key and one that holds no number.
  double number(const std::string& key) const;
  /// All keys, in the order of the reference.
  static std::vector<Key> keys();

  /// Checks what can be checked without placing discs: rules across keys, overlapping holes, walls against the horizon.
  /// Returns warnings, a sentence each. Throws Error for a design that cannot be evaluated.
  std::vector<std::string> check() const;
  /// The complete design as TOML: every key, in SI, with all digits.
  std::string to_toml() const;

 private:
  friend struct Inside;
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace perfora
