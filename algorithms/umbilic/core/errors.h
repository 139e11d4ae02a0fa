// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace umbilic {

/// Base of every error Umbilic throws. what() is one line: what is wrong, where, and what to do.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An input is not what it claims to be: a file that cannot be read, a knot vector that decreases, a tolerance below
/// zero.
class InvalidInput : public Error {
public:
    using Error::Error;
};

/// The input is valid, but of a kind that Umbilic does not treat.
class Unsupported : public Error {
public:
    using Error::Error;
};

/// A computation on valid input could not be finished: no convergence, an exhausted budget, a time or memory limit.
class NumericFailure : public Error {
public:
    using Error::Error;
};

/// The caller asked to stop (Progress::cancel, Ctrl-C, a callback that returned false).
class Cancelled : public Error {
public:
    using Error::Error;
};

}  // namespace umbilic
