//! Two, three or four numbers per lane.

use super::{Real, ToLanes};
use crate::lanes::{Lanes, Scalar};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// Two numbers per lane, such as texture coordinates.
///
/// `+ - * /` work component by component with another `Vec2<L>` or a plain `[f32; 2]`, and with one number (`Real<L>` or
/// `f32`) for both components, on either side.
pub struct Vec2<L: Lanes = Scalar> {
    /// The first component.
    pub x: Real<L>,
    /// The second component.
    pub y: Real<L>,
}

/// Three numbers per lane: a point, a direction, or a colour in linear light.
///
/// `+ - * /` work component by component with another `Vec3<L>` or a plain `[f32; 3]`, and with one number (`Real<L>` or
/// `f32`) for all components, on either side.
pub struct Vec3<L: Lanes = Scalar> {
    /// The first component; red of a colour.
    pub x: Real<L>,
    /// The second component; green of a colour.
    pub y: Real<L>,
    /// The third component; blue of a colour.
    pub z: Real<L>,
}

/// Four numbers per lane, such as a position in clip space.
///
/// `+ - * /` work component by component with another `Vec4<L>` or a plain `[f32; 4]`, and with one number (`Real<L>` or
/// `f32`) for all components, on either side.
pub struct Vec4<L: Lanes = Scalar> {
    /// The first component.
    pub x: Real<L>,
    /// The second component.
    pub y: Real<L>,
    /// The third component.
    pub z: Real<L>,
    /// The fourth component.
    pub w: Real<L>,
}

/// What any fixed row of numbers has: copies, component-wise operators, mixing. Also used for [`Rgba`](super::Rgba).
macro_rules! components {
    ($vector:ident $n:literal: $first:ident $($rest:ident)+) => {
        impl<L: Lanes> $vector<L> {
            /// The width of these numbers.
            #[inline(always)]
            pub fn lanes(self) -> L {
                self.$first.lanes()
            }

            /// The larger of each two components, as [`Real::max`].
            #[inline(always)]
            pub fn max(self, b: impl ToLanes<L, Self>) -> Self {
                let b = b.to_lanes(self.lanes());
                Self { $first: self.$first.max(b.$first), $($rest: self.$rest.max(b.$rest)),+ }
            }

            /// The smaller of each two components, as [`Real::min`].
            #[inline(always)]
            pub fn min(self, b: impl ToLanes<L, Self>) -> Self {
                let b = b.to_lanes(self.lanes());
                Self { $first: self.$first.min(b.$first), $($rest: self.$rest.min(b.$rest)),+ }
            }

            /// `self.max(low).min(high)`.
            #[inline(always)]
            pub fn clamp(self, low: impl ToLanes<L, Self>, high: impl ToLanes<L, Self>) -> Self {
                self.max(low).min(high)
            }

            /// `self + (b - self) * t`: from `self` at `t = 0` to `b` (up to rounding) at `t = 1`.
            #[inline(always)]
            pub fn mix(self, b: impl ToLanes<L, Self>, t: impl ToLanes<L, Real<L>>) -> Self {
                let lanes = self.lanes();
                self + (b.to_lanes(lanes) - self) * t.to_lanes(lanes)
            }

            /// [`mix`](Self::mix) by its other name.
            #[inline(always)]
            pub fn lerp(self, b: impl ToLanes<L, Self>, t: impl ToLanes<L, Real<L>>) -> Self {
                self.mix(b, t)
            }
        }

        impl<L: Lanes> Clone for $vector<L> {
            #[inline(always)]
            fn clone(&self) -> Self {
                *self
            }
        }
        impl<L: Lanes> Copy for $vector<L> {}

        impl<L: Lanes> core::fmt::Debug for $vector<L> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_struct(stringify!($vector))
                    .field(stringify!($first), &self.$first)
                    $(.field(stringify!($rest), &self.$rest))+
                    .finish()
            }
        }
        impl Default for $vector<Scalar> {
            fn default() -> Self {
                [0.0; $n].into()
            }
        }
        impl PartialEq for $vector<Scalar> {
            fn eq(&self, b: &Self) -> bool {
                <[f32; $n]>::from(*self) == <[f32; $n]>::from(*b)
            }
        }

        impl<L: Lanes> Neg for $vector<L> {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self { $first: -self.$first, $($rest: -self.$rest),+ }
            }
        }
        components!(@operator $vector $n Add add AddAssign add_assign: $first $($rest)+);
        components!(@operator $vector $n Sub sub SubAssign sub_assign: $first $($rest)+);
        components!(@operator $vector $n Mul mul MulAssign mul_assign: $first $($rest)+);
        components!(@operator $vector $n Div div DivAssign div_assign: $first $($rest)+);
    };

    (@operator $vector:ident $n:literal $operator:ident $function:ident $assign:ident $assign_function:ident:
     $($field:ident)+) => {
        impl<L: Lanes> $operator for $vector<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: Self) -> Self {
                Self { $($field: self.$field.$function(b.$field)),+ }
            }
        }
        impl<L: Lanes> $operator<Real<L>> for $vector<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: Real<L>) -> Self {
                Self { $($field: self.$field.$function(b)),+ }
            }
        }
        impl<L: Lanes> $operator<f32> for $vector<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: f32) -> Self {
                Self { $($field: self.$field.$function(b)),+ }
            }
        }
        impl<L: Lanes> $operator<[f32; $n]> for $vector<L> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, b: [f32; $n]) -> Self {
                let b: Self = b.to_lanes(self.lanes());
                self.$function(b)
            }
        }
        impl<L: Lanes> $operator<$vector<L>> for [f32; $n] {
            type Output = $vector<L>;
            #[inline(always)]
            fn $function(self, b: $vector<L>) -> $vector<L> {
                let a: $vector<L> = self.to_lanes(b.lanes());
                a.$function(b)
            }
        }
        impl<L: Lanes> $operator<$vector<L>> for Real<L> {
            type Output = $vector<L>;
            #[inline(always)]
            fn $function(self, b: $vector<L>) -> $vector<L> {
                $vector { $($field: self.$function(b.$field)),+ }
            }
        }
        impl<L: Lanes> $operator<$vector<L>> for f32 {
            type Output = $vector<L>;
            #[inline(always)]
            fn $function(self, b: $vector<L>) -> $vector<L> {
                $vector { $($field: self.$function(b.$field)),+ }
            }
        }
        impl<L: Lanes, B: ToLanes<L, Self>> $assign<B> for $vector<L> {
            #[inline(always)]
            fn $assign_function(&mut self, b: B) {
                *self = (*self).$function(b.to_lanes(self.lanes()));
            }
        }
    };
}
pub(super) use components;

components!(Vec2 2: x y);
components!(Vec3 3: x y z);
components!(Vec4 4: x y z w);

/// A plain array times a number per lane: uniforms need no splat.
macro_rules! array_times_real {
    ($($vector:ident $n:literal),+) => {
        $(
            array_times_real!(@ $vector $n Add add);
            array_times_real!(@ $vector $n Sub sub);
            array_times_real!(@ $vector $n Mul mul);
            array_times_real!(@ $vector $n Div div);
        )+
    };
    (@ $vector:ident $n:literal $operator:ident $function:ident) => {
        impl<L: Lanes> $operator<Real<L>> for [f32; $n] {
            type Output = $vector<L>;
            #[inline(always)]
            fn $function(self, b: Real<L>) -> $vector<L> {
                let a: $vector<L> = self.to_lanes(b.lanes());
                a.$function(b)
            }
        }
    };
}

array_times_real!(Vec2 2, Vec3 3, Vec4 4);

macro_rules! geometry {
    ($vector:ident: $first:ident $($rest:ident)+) => {
        impl<L: Lanes> $vector<L> {
            /// The sum of the products of the components, added from the first on.
            #[inline(always)]
            pub fn dot(self, b: impl ToLanes<L, Self>) -> Real<L> {
                let b = b.to_lanes(self.lanes());
                self.$first * b.$first $(+ self.$rest * b.$rest)+
            }

            /// The square of the length: no root to take.
            #[inline(always)]
            pub fn length_squared(self) -> Real<L> {
                self.dot(self)
            }

            /// The length. Components above 1e19 overflow to infinity and below 1e-23 vanish, as their squares do.
            #[inline(always)]
            pub fn length(self) -> Real<L> {
                self.dot(self).sqrt()
            }

            /// The distance between two points.
            #[inline(always)]
            pub fn distance(self, b: impl ToLanes<L, Self>) -> Real<L> {
                (self - b.to_lanes(self.lanes())).length()
            }

            /// The vector of length 1 in the same direction, to within 3 ULP; **zero for the zero vector**, and for
            /// one so short that its squared length is not a normal number (below 1.1e-19). A vector so long that its squared length
            /// overflows (above 1.8e19) gives zero too; NaN gives NaN.
            #[inline(always)]
            pub fn normalize(self) -> Self {
                let squared = self.dot(self);
                let vanishes = squared.lt(f32::MIN_POSITIVE) | squared.eq(f32::INFINITY);
                self * vanishes.select(0.0, squared.inverse_sqrt_of_normal())
            }

            /// This direction mirrored at a surface with the unit normal `normal`: `self - 2 (self . normal) normal`.
            #[inline(always)]
            pub fn reflect(self, normal: impl ToLanes<L, Self>) -> Self {
                let normal = normal.to_lanes(self.lanes());
                self - normal * (2.0 * self.dot(normal))
            }

            /// This direction, of length 1, bent where it enters a surface with the unit normal `normal` (which points against it): GLSL's
            /// `refract`. `eta` is the refractive index that it comes from over the one that it goes to. Zero where all light is reflected.
            ///
            /// ```
            /// # use pineda::*;
            /// let down = Vec2::from([0.6, -0.8]);
            /// assert_eq!(down.refract([0.0, 1.0], 1.0), down);
            /// assert_eq!(Vec2::from([0.8, -0.6]).refract([0.0, 1.0], 1.5), Vec2::from([0.0, 0.0]));
            /// ```
            #[inline(always)]
            pub fn refract(self, normal: impl ToLanes<L, Self>, eta: impl ToLanes<L, Real<L>>) -> Self {
                let lanes = self.lanes();
                let (normal, eta) = (normal.to_lanes(lanes), eta.to_lanes(lanes));
                let cosine = self.dot(normal);
                let squared = 1.0 - eta * eta * (1.0 - cosine * cosine);
                let bent = self * eta - normal * (eta * cosine + squared.max(0.0).sqrt());
                let is_reflected = squared.lt(0.0);
                Self { $first: is_reflected.select(0.0, bent.$first), $($rest: is_reflected.select(0.0, bent.$rest)),+ }
            }

            /// This normal, turned to the side that the direction `incident` comes from, as `reference` has it: `self` where
            /// `reference . incident < 0`, `-self` elsewhere; GLSL's `faceforward`.
            #[inline(always)]
            pub fn faceforward(self, incident: impl ToLanes<L, Self>, reference: impl ToLanes<L, Self>) -> Self {
                let lanes = self.lanes();
                let faces = reference.to_lanes(lanes).dot(incident.to_lanes(lanes)).lt(0.0);
                Self { $first: faces.select(self.$first, -self.$first), $($rest: faces.select(self.$rest, -self.$rest)),+ }
            }
        }
    };
}

geometry!(Vec2: x y);
geometry!(Vec3: x y z);
geometry!(Vec4: x y z w);

impl<L: Lanes> Vec2<L> {
    /// (x, y).
    #[inline(always)]
    pub fn new(x: Real<L>, y: Real<L>) -> Self {
        Self { x, y }
    }

    /// The z component of the cross product: twice the area of the triangle with these two sides, positive where `b` lies to the left.
    #[inline(always)]
    pub fn cross(self, b: impl ToLanes<L, Self>) -> Real<L> {
        let b = b.to_lanes(self.lanes());
        self.x * b.y - self.y * b.x
    }

    /// (x, y, `z`).
    #[inline(always)]
    pub fn extend(self, z: impl ToLanes<L, Real<L>>) -> Vec3<L> {
        Vec3 { x: self.x, y: self.y, z: z.to_lanes(self.lanes()) }
    }
}

impl<L: Lanes> Vec3<L> {
    /// (x, y, z).
    #[inline(always)]
    pub fn new(x: Real<L>, y: Real<L>, z: Real<L>) -> Self {
        Self { x, y, z }
    }

    /// (x, y, z, `w`): with `w = 1` a point, ready for a matrix.
    #[inline(always)]
    pub fn extend(self, w: impl ToLanes<L, Real<L>>) -> Vec4<L> {
        Vec4 { x: self.x, y: self.y, z: self.z, w: w.to_lanes(self.lanes()) }
    }

    /// The cross product: at right angles to both, right-handed.
    #[inline(always)]
    pub fn cross(self, b: impl ToLanes<L, Self>) -> Self {
        let b = b.to_lanes(self.lanes());
        Self { x: self.y * b.z - self.z * b.y, y: self.z * b.x - self.x * b.z, z: self.x * b.y - self.y * b.x }
    }
}

impl<L: Lanes> Vec4<L> {
    /// (x, y, z, w).
    #[inline(always)]
    pub fn new(x: Real<L>, y: Real<L>, z: Real<L>, w: Real<L>) -> Self {
        Self { x, y, z, w }
    }
}
