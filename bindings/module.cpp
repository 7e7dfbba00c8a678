// What is here: the module perfora._core, its errors and versions. What is not: its types and functions.
#include <exception>

#include "bindings/bind.h"

namespace perfora::python {

/// Raised with every change that a program which uses the module may notice.
constexpr int interface_version = 1;

}  // namespace perfora::python

PYBIND11_MODULE(_core, module) {
  using namespace perfora::python;
  module.doc() = "What the package perfora is made of.";
  py::register_exception<perfora::Error>(module, "InputError", PyExc_ValueError);
  py::register_exception<perfora::SurroundingsError>(module, "SurroundingsError", PyExc_OSError);
  module.attr("interface_version") = interface_version;
  module.attr("__version__") = PERFORA_VERSION;
  add_designs(module);
  add_results(module);
  add_files(module);
  add_work(module);
  add_studies(module);
}
