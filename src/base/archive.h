#pragma once
// Archives of named values, for files in CBOR. A function describes the content of a file once: it passes each part to the
// archive, which writes the part or reads it back. StoreWriter and StoreReader therefore have the same functions. The reader
// throws std::runtime_error or json::exception for a part that is missing, of another type, or out of range.

#include "base/packed_array.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace sunfleck {

// Writes one value: a number, a text, a list, or a map whose values are written through operator[].
class StoreWriter {
 public:
  static constexpr bool reads = false;

  explicit StoreWriter(nlohmann::json& to) : to_(to) {}

  // Returns the writer of a value in a map (by name) or in a list (by number).
  template <class Key>
  [[nodiscard]] StoreWriter operator[](Key key) const {
    return StoreWriter(to_[key]);
  }

  // Writes a number, a flag, a text or a list of them. A reader accepts only numbers in lo..hi, if these are given.
  template <class T>
  void value(const T& value) const {
    to_ = value;
  }
  template <class T>
  void value(const T& value, double /*lo*/, double /*hi*/) const {
    to_ = value;
  }
  // Writes null if there is no value.
  template <class T>
  void value(const std::optional<T>& value) const {
    to_ = value ? nlohmann::json(*value) : nlohmann::json(nullptr);
  }
  // Writes a value that files from earlier builds do not have; a reader then leaves it as it is.
  template <class T>
  void recent_value(const char* key, const T& value) const {
    to_[key] = value;
  }
  // Writes the numbers as one list. A reader accepts only a list of that length, with numbers in lo..hi.
  template <class... T>
  void row(double /*lo*/, double /*hi*/, const T&... values) const {
    to_ = nlohmann::json::array({values...});
  }
  // Writes a long array, deflated. A reader accepts only `count` values, and allocates no memory for them if the file is too
  // short to hold them.
  template <class T>
  void packed(const std::vector<T>& values, std::size_t /*count*/) const {
    to_ = pack(values);
  }
  template <class T>
  void packed(const NumberPieces<T>& values, std::size_t count) const {
    to_ = pack(values, count);
  }

  // Writes a list, each part by `visit(archive, part)`.
  template <class Part, class Visit>
  void list(const std::vector<Part>& parts, const Visit& visit) const {
    to_ = nlohmann::json::array();
    for (const Part& part : parts) visit(StoreWriter(to_.emplace_back()), part);
  }
  // Writes a part by `visit(archive, part)`, or null if there is none.
  template <class Part, class Visit>
  void part(const std::optional<Part>& part, const Visit& visit) const {
    if (part) visit(*this, *part);
  }

 private:
  nlohmann::json& to_;
};

// Reads one value of a file; see StoreWriter.
class StoreReader {
 public:
  static constexpr bool reads = true;

  // `name` identifies the value in messages.
  explicit StoreReader(const nlohmann::json& from, const char* name = "the content") : from_(from), name_(name) {}

  [[nodiscard]] StoreReader operator[](const char* key) const { return StoreReader(from_.at(key), key); }
  [[nodiscard]] StoreReader operator[](int index) const {
    return StoreReader(from_.at(static_cast<std::size_t>(index)), name_);
  }

  template <class T>
  void value(T& value) const {
    if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      value = whole<T>(from_);
    } else {
      value = from_.get<T>();
    }
  }
  template <class T>
  void value(std::optional<T>& value) const {
    if (!from_.is_null()) this->value(value.emplace());
  }
  template <class T>
  void value(T& value, double lo, double hi) const {
    this->value(value);
    require(value >= lo && value <= hi);
  }
  template <class T>
  void value(std::vector<T>& values, double lo, double hi) const {
    value(values);
    for (const T& value : values) require(value >= lo && value <= hi);
  }
  template <class T>
  void recent_value(const char* key, T& value) const {
    if (from_.contains(key)) (*this)[key].value(value);
  }
  template <class... T>
  void row(double lo, double hi, T&... values) const {
    require(from_.size() == sizeof...(T));
    int index = 0;
    ((*this)[index++].value(values, lo, hi), ...);
  }
  template <class T>
  void packed(std::vector<T>& values, std::size_t count) const {
    values = unpack<T>(from_, count);
  }

  template <class Part, class Visit>
  void list(std::vector<Part>& parts, const Visit& visit) const {
    for (const nlohmann::json& part : from_) visit(StoreReader(part, name_), parts.emplace_back());
  }
  template <class Part, class Visit>
  void part(std::optional<Part>& part, const Visit& visit) const {
    if (!from_.is_null()) visit(*this, part.emplace());
  }

 private:
  void require(bool good) const {
    if (!good) throw std::runtime_error(std::string(name_) + " is out of range");
  }

  const nlohmann::json& from_;
  const char* name_;
};

}  // namespace sunfleck
