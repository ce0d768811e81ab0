#include "adapt/pass_report.hpp"

#include <initializer_list>

namespace cnem::adapt {

PassReport& PassReport::operator+=(const PassReport& other) {
  for (int PassReport::*count :
       {&PassReport::cracks, &PassReport::advances, &PassReport::cuts, &PassReport::opened,
        &PassReport::films, &PassReport::crumbs, &PassReport::folded, &PassReport::outside,
        &PassReport::removed, &PassReport::removed_boundary, &PassReport::promoted, &PassReport::inserted,
        &PassReport::inserted_boundary, &PassReport::flipped, &PassReport::recut, &PassReport::balanced,
        &PassReport::undone, &PassReport::crossings, &PassReport::side_crossings})
    this->*count += other.*count;
  volume_change += other.volume_change;
  return *this;
}

} // namespace cnem::adapt
