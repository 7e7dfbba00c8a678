// What is here: what the files of the Python module share: their parts of the module, views of arrays, designs in any
// form. What is not: anything of the library itself (perfora/).
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "perfora/design.h"
#include "perfora/results.h"

namespace perfora::python {

namespace py = pybind11;

/// The parts of the module, in the order in which their types must be known.
void add_designs(py::module_& module);
void add_results(py::module_& module);
void add_files(py::module_& module);
void add_work(py::module_& module);
void add_studies(py::module_& module);

/// A read-only NumPy array of values that live in the C++ object that `owner` (a Python object) holds: no copy, and the
/// owner lives as long as the array. `columns`: of a two-dimensional array, row by row; 0: one-dimensional.
template <class Number>
py::array view(const py::object& owner, const Number* values, std::size_t size, std::size_t columns = 0) {
  const auto step = static_cast<py::ssize_t>(sizeof(Number));
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(size)}, strides = {step};
  if (columns > 0) {
    shape = {static_cast<py::ssize_t>(size / columns), static_cast<py::ssize_t>(columns)};
    strides = {step * static_cast<py::ssize_t>(columns), step};
  }
  py::array made(py::dtype::of<Number>(), shape, strides, values, owner);
  made.attr("flags").attr("writeable") = false;
  return made;
}

/// The same for a member of a bound class.
template <class Class, class Number>
auto view_of(std::vector<Number> Class::*member, std::size_t columns = 0) {
  return [member, columns](const py::object& self) {
    const std::vector<Number>& values = self.cast<const Class&>().*member;
    return view(self, values.data(), values.size(), columns);
  };
}

/// A part of an object, which keeps the whole alive.
template <class Whole, class Part>
auto part_of(Part Whole::*member) {
  return
      [member](const std::shared_ptr<Whole>& whole) { return std::shared_ptr<Part>(whole, &(whole.get()->*member)); };
}

/// "completed", "stopped", "failed".
const char* name_of(Status status);
/// The measures by their keys.
py::dict dict_of(const std::vector<Measure>& measures);
/// A JSON text as dicts and lists; None for an empty text.
py::object from_json(const std::string& text);

/// A Design, a mapping or the path of a design file as a design. Throws Error, and TypeError for anything else.
Design design_from(const py::object& source);
/// Sets every key of a mapping, nested or flat ("layout.diameter").
void set_all(Design& design, const py::dict& changes);
/// A mapping, nested or flat, as what `--set` takes.
std::vector<std::string> overrides_from(const py::object& changes);

}  // namespace perfora::python
