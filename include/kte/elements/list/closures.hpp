// No `#pragma once`: read once for each use of KTE_ELEMENT.

/// Closures of loops and contacts. Part of the list kte/elements/all.hpp.
#ifndef KTE_ELEMENT
#  define KTE_ELEMENT(...)
#endif

// clang-format off
#include <kte/elements/bristle_contact.hpp>
KTE_ELEMENT(bristle_contact<kind::frame_2D, core::contact_geometry<kind::frame_2D>>)
KTE_ELEMENT(bristle_contact<kind::frame_3D, core::contact_geometry<kind::frame_3D>>)
#include <kte/elements/closures/axis_closures.hpp>
KTE_ELEMENT(cylindrical_3D)
KTE_ELEMENT(hinge_3D)
KTE_ELEMENT(sliding<kind::frame_2D>)
KTE_ELEMENT(sliding<kind::frame_3D>)
KTE_ELEMENT(universal_3D)
#include <kte/elements/closures/coincident_frames.hpp>
KTE_ELEMENT(coincident_frames<kind::frame_2D>)
KTE_ELEMENT(coincident_frames<kind::frame_3D>)
#include <kte/elements/closures/coincident_points.hpp>
KTE_ELEMENT(coincident_points<kind::frame_2D>)
KTE_ELEMENT(coincident_points<kind::frame_3D>)
#include <kte/elements/closures/coupled_coordinates.hpp>
KTE_ELEMENT(coupled_by_polynomial)
KTE_ELEMENT(coupled_coordinates)
#include <kte/elements/closures/point_closures.hpp>
KTE_ELEMENT(distance<kind::frame_2D>)
KTE_ELEMENT(distance<kind::frame_3D>)
KTE_ELEMENT(point_on_line<kind::frame_2D>)
KTE_ELEMENT(point_on_line<kind::frame_3D>)
KTE_ELEMENT(point_on_plane_3D)
#include <kte/elements/compliant_contact.hpp>
KTE_ELEMENT(compliant_contact<kind::frame_2D, core::contact_geometry<kind::frame_2D>>)
KTE_ELEMENT(compliant_contact<kind::frame_3D, core::contact_geometry<kind::frame_3D>>)
KTE_ELEMENT(compliant_contact<kind::frame_3D, core::disc_geometry>)
#include <kte/elements/compliant_shapes.hpp>
#include <kte/elements/rigid_contact.hpp>
KTE_ELEMENT(rigid_contact<kind::frame_2D, core::contact_geometry<kind::frame_2D>>)
KTE_ELEMENT(rigid_contact<kind::frame_3D, core::contact_geometry<kind::frame_3D>>)
KTE_ELEMENT(rigid_contact<kind::frame_3D, core::disc_geometry>)
#include <kte/elements/rigid_shapes.hpp>
// clang-format on
