#pragma once
// Constants that users give, declared once, where they are used: keys, units, ranges, checks and documents of
// a case follow from the declaration. Vector kernels see this header too: no function definitions and no
// standard containers here.

namespace cnem {

inline constexpr double infinite = __builtin_huge_val();

/// Values that a quantity may have, in SI.
struct Range {
  double low = -infinite;
  double high = infinite;
  bool low_open = false, high_open = false;

  bool contains(double value) const;
  bool bounded() const;
};

inline constexpr Range anything{};
inline constexpr Range positive{.low = 0.0, .low_open = true};
inline constexpr Range not_negative{.low = 0.0};
inline constexpr Range fraction{.low = 0.0, .high = 1.0};
inline constexpr Range temperature_range = not_negative; ///< K

/// What is known of a constant beside its value.
struct ParameterInfo {
  const char* name;          ///< as in a case
  const char* unit = "";     ///< SI; "": a plain number
  Range range = anything;    ///< in which it is valid
  bool required = false;     ///< else the member's initial value is its default; infinite: it has none
  const char* meaning = "";  ///< a sentence
  const char* source = "";   ///< paper and equation, where it is not the law's
  const char* example = "";  ///< "210 GPa"
  const char* computed = ""; ///< words for a default that depends on other keys
};

/// A member of Owner and what is known of it. A struct of constants lists its own as
///   static constexpr Parameter<Owner> parameters[] = {{&Owner::member, {.name = …}}, …};
template<class Owner> struct Parameter {
  double Owner::*value;
  ParameterInfo info;
};

/// Numbers in place, so that a struct that holds a list stays plain.
struct NumberList {
  static constexpr int capacity = 64;
  double value[capacity] = {};
  int size = 0;
};

/// A list among the constants; the range is that of each number. Its struct lists them as
///   static constexpr ListParameter<Owner> lists[] = {{&Owner::member, {.name = …}}, …};
template<class Owner> struct ListParameter {
  NumberList Owner::*value;
  ParameterInfo info;
};

/// Of two constants of a law the first is larger than the second, or as large where that is allowed.
struct Order {
  const char* larger;
  const char* smaller;
  bool may_equal = false;
};

/// Laws of one kind, in the order of documents. Each is a struct of constants with
///   name        as in a case
///   formula     in words or symbols, with the names of its constants
///   source      paper and equation
///   parameters  as above
///   lists       optional, as above
///   complete()  optional: works out what follows from the constants; throws InputError where they do not fit
///   orders      optional, Order[]: pairs of constants
///   strength    optional, const char*[]: constants of which at least one is positive
template<class... Law> struct Laws {};

} // namespace cnem
