//! What vectors do component by component, and their components in other orders.

use super::{Real, ToLanes, Vec2, Vec3, Vec4};
use crate::lanes::Lanes;

/// Functions of one number; the fields as one token, so that they can stand in each.
macro_rules! of_each {
    ($vector:ident $fields:tt: $($function:ident)+) => {
        impl<L: Lanes> $vector<L> {$(
            #[doc = concat!("[`Real::", stringify!($function), "`] of each component.")]
            #[inline(always)]
            pub fn $function(self) -> Self {
                of_each!(@ $vector self $function $fields)
            }
        )+}
    };
    (@ $vector:ident $self:ident $function:ident ($($field:ident)+)) => {
        $vector { $($field: $self.$field.$function()),+ }
    };
}

macro_rules! functions {
    ($($vector:ident: $first:ident $($rest:ident)+;)+) => {$(
        of_each! {
            $vector ($first $($rest)+):
            abs sign floor ceil round trunc fract saturate squared sqrt inverse_sqrt exp exp2 log log2 sin cos
        }

        impl<L: Lanes> $vector<L> {
            /// [`Real::powf`] of each component, all to the same power.
            #[inline(always)]
            pub fn powf(self, n: impl ToLanes<L, Real<L>>) -> Self {
                let n = n.to_lanes(self.lanes());
                Self { $first: self.$first.powf(n), $($rest: self.$rest.powf(n)),+ }
            }

            /// [`Real::modulo`] of each component.
            #[inline(always)]
            pub fn modulo(self, b: impl ToLanes<L, Self>) -> Self {
                let b = b.to_lanes(self.lanes());
                Self { $first: self.$first.modulo(b.$first), $($rest: self.$rest.modulo(b.$rest)),+ }
            }

            /// [`Real::step`] of each component.
            #[inline(always)]
            pub fn step(self, edge: impl ToLanes<L, Self>) -> Self {
                let edge = edge.to_lanes(self.lanes());
                Self { $first: self.$first.step(edge.$first), $($rest: self.$rest.step(edge.$rest)),+ }
            }

            /// [`Real::smoothstep`] of each component.
            #[inline(always)]
            pub fn smoothstep(self, low: impl ToLanes<L, Self>, high: impl ToLanes<L, Self>) -> Self {
                let (low, high) = (low.to_lanes(self.lanes()), high.to_lanes(self.lanes()));
                Self {
                    $first: self.$first.smoothstep(low.$first, high.$first),
                    $($rest: self.$rest.smoothstep(low.$rest, high.$rest)),+
                }
            }

            /// The largest component.
            #[inline(always)]
            pub fn max_component(self) -> Real<L> {
                self.$first$(.max(self.$rest))+
            }

            /// The smallest component.
            #[inline(always)]
            pub fn min_component(self) -> Real<L> {
                self.$first$(.min(self.$rest))+
            }
        }
    )+};
}

functions! {
    Vec2: x y;
    Vec3: x y z;
    Vec4: x y z w;
}

/// The components in the order of the method's name.
macro_rules! swizzles {
    ($vector:ident: $($name:ident $to:ident ($($field:ident $from:ident),+);)+) => {
        impl<L: Lanes> $vector<L> {$(
            #[doc = concat!("(", stringify!($($from),+), ").")]
            #[inline(always)]
            pub fn $name(self) -> $to<L> {
                $to { $($field: self.$from),+ }
            }
        )+}
    };
}

swizzles! { Vec2:
    yx Vec2 (x y, y x);
}
swizzles! { Vec3:
    xy Vec2 (x x, y y);
    xz Vec2 (x x, y z);
    yx Vec2 (x y, y x);
    yz Vec2 (x y, y z);
    zx Vec2 (x z, y x);
    zy Vec2 (x z, y y);
    xzy Vec3 (x x, y z, z y);
    yxz Vec3 (x y, y x, z z);
    yzx Vec3 (x y, y z, z x);
    zxy Vec3 (x z, y x, z y);
    zyx Vec3 (x z, y y, z x);
}
swizzles! { Vec4:
    xy Vec2 (x x, y y);
    xz Vec2 (x x, y z);
    yz Vec2 (x y, y z);
    yw Vec2 (x y, y w);
    zw Vec2 (x z, y w);
    xyz Vec3 (x x, y y, z z);
    yzw Vec3 (x y, y z, z w);
    zyx Vec3 (x z, y y, z x);
    wzyx Vec4 (x w, y z, z y, w x);
    zwxy Vec4 (x z, y w, z x, w y);
}
