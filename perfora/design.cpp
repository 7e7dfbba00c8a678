// What is here: a design of the library over the design file of optimize/evaluate. What is not: what its keys do.
#include "perfora/design.h"

#include "io/text.h"
#include "io/units.h"
#include "perfora/inside.h"

namespace perfora {

namespace {

KeyType public_type(io::KeyType type) {
  switch (type) {
    case io::KeyType::real:
      return KeyType::real;
    case io::KeyType::integer:
      return KeyType::integer;
    case io::KeyType::boolean:
      return KeyType::boolean;
    case io::KeyType::text:
      return KeyType::text;
    case io::KeyType::choice:
      return KeyType::choice;
    case io::KeyType::path:
      return KeyType::path;
    case io::KeyType::real_list:
      return KeyType::real_list;
    case io::KeyType::real_rows:
      return KeyType::real_rows;
  }
  return KeyType::text;
}

bool holds_numbers(const io::Key& key) {
  return key.numeric() || key.type == io::KeyType::real_list || key.type == io::KeyType::real_rows;
}

}  // namespace

Error::Error(const std::string& sentence) : std::runtime_error(sentence) {}
SurroundingsError::SurroundingsError(const std::string& sentence) : std::runtime_error(sentence) {}

Design::Design() : content_(std::make_unique<Content>()) {}
Design::Design(const Design& other) : content_(std::make_unique<Content>(Content{other.content_->file.clone()})) {}
Design::Design(Design&& other) noexcept = default;
Design& Design::operator=(const Design& other) {
  if (this != &other) content_ = std::make_unique<Content>(Content{other.content_->file.clone()});
  return *this;
}
Design& Design::operator=(Design&& other) noexcept = default;
Design::~Design() = default;

Design Design::from_file(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return at_boundary([&] { return Inside::design(optimize::DesignFile(file, overrides)); });
}

Design Design::from_toml(const std::string& text, const std::string& name) {
  return at_boundary([&] { return Inside::design(optimize::DesignFile::from_toml(text, name)); });
}

Design& Design::set(const std::string& key, const std::string& value) {
  at_boundary([&] {
    try {
      content_->file.schema().set_override(key + "=" + value);
    } catch (const io::InputError& error) {
      // Callers of the library know of no flag.
      const std::string sentence = error.what(), flag = "--set: ";
      throw Error(sentence.starts_with(flag) ? sentence.substr(flag.size()) : sentence);
    }
  });
  return *this;
}

Design& Design::set(const std::string& key, double value) {
  at_boundary([&] { content_->file.schema().set_number(key, value, {"", 0, key}); });
  return *this;
}

std::string Design::text(const std::string& key) const {
  return at_boundary([&] {
    const io::Value value = content_->file.schema().at(key).get();
    if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
    return io::toml_literal(value, io::Digits::shortest);
  });
}

double Design::number(const std::string& key) const {
  return at_boundary([&] { return content_->file.schema().get_number(key); });
}

std::vector<Key> Design::keys() {
  const optimize::DesignFile defaults;
  std::vector<Key> found;
  for (const io::Key& key : defaults.schema().keys())
    found.push_back({key.full_name(), public_type(key.type), std::string(io::dimension_name(key.dimension)),
                     std::string(io::si_unit(key.dimension)), key.default_text,
                     holds_numbers(key) ? key.range.text() : std::string(), key.choices, key.help});
  return found;
}

std::vector<std::string> Design::check() const {
  return at_boundary([&] { return content_->file.validate(); });
}

std::string Design::to_toml() const {
  return content_->file.schema().to_toml();
}

}  // namespace perfora
