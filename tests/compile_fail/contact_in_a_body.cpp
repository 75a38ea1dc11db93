// expect: error: .*kte: no joint moves the frames of this contact relative to each other
// expect: check_frames_of_contact<end_, tip_, foot_, false>
#include <kte/contacts.hpp>

#include "touching_slide.hpp"

inline constexpr struct tip_ final : kte::frame_2D_key<"tip"> {
} tip;

constexpr auto slide =
    kte::chain(kte::prismatic_joint_2D(q, base, end, kte::axis::y), kte::inertia_2D(end, kte::point_mass(1.0)),
               kte::rigid_link_2D(end, tip, kte::along_x(0.5)),
               kte::point_contact_2D(foot, end, tip, kte::half_space{}, {0.5, 0}));
double x() { return kte::contact_dynamics(slide, at_zero, at_zero, at_zero).a[0]; }
