// mediant.hpp: the library in C++17, over mediant.h. A program that includes it links against libmediant.
//
// - Objects are of classes that can be moved, not copied. Each frees what it holds. Objects that are made of
//   others do not need those to stay.
// - Mistakes are exceptions: mediant::error, with the code and the sentence of the library.
// - Results are values: all vectors, texts and paths that a function returns are the caller's. Only a
//   mediant::view leads to memory of another; each function that returns one says whose.
// - Any number of threads may use the same object, but for planners: each thread makes its own.
#ifndef MEDIANT_HPP
#define MEDIANT_HPP

#include "mediant/planners.hpp"
#include "mediant/spaces.hpp"
#include "mediant/values.hpp"

#endif
