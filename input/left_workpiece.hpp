#pragma once
// The file in which a milling run leaves its workpiece for the next one.

namespace cnem::input {

inline constexpr const char* left_workpiece = "workpiece.h5"; ///< in the folder of the run

} // namespace cnem::input
