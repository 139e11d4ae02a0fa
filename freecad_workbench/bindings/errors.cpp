// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bind.h"

#include <string>

#include <umbilic/core/errors.h>

namespace umbilic::python {

namespace py = pybind11;

namespace {

// The exception types live as long as the interpreter, as those of any extension module.
PyObject* error = nullptr;
PyObject* invalid_input = nullptr;
PyObject* unsupported = nullptr;
PyObject* numeric_failure = nullptr;
PyObject* cancelled = nullptr;

PyObject* make_exception(py::module_& module, const char* name, const char* doc, PyObject* base) {
    // Named for the package, where users meet it, and not for this module.
    const std::string full_name = std::string("umbilic.") + name;
    PyObject* type = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base, nullptr);
    if (!type) throw py::error_already_set();
    module.add_object(name, type);
    return type;
}

void translate(std::exception_ptr pointer) {
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const InvalidInput& e) {
        PyErr_SetString(invalid_input, e.what());
    } catch (const Unsupported& e) {
        PyErr_SetString(unsupported, e.what());
    } catch (const NumericFailure& e) {
        PyErr_SetString(numeric_failure, e.what());
    } catch (const Cancelled& e) {
        PyErr_SetString(cancelled, e.what());
    } catch (const Error& e) {
        PyErr_SetString(error, e.what());
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    error = make_exception(module, "Error",
                           "Base of every error Umbilic raises; one line: what is wrong, where, what to do.",
                           PyExc_Exception);
    invalid_input = make_exception(module, "InvalidInput", "An input is not what it claims to be.", error);
    unsupported = make_exception(module, "Unsupported", "A valid input of a kind that Umbilic does not treat.", error);
    numeric_failure =
        make_exception(module, "NumericFailure",
                       "The work on valid input could not be finished: no convergence, a time or memory limit.", error);
    cancelled = make_exception(module, "Cancelled", "The progress callback returned False.", error);
    py::register_exception_translator(&translate);
}

}  // namespace umbilic::python
