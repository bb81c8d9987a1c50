//! Whatever `#[shader]` may stand above, and what shaders are put together from.

#![allow(unreachable_pub, reason = "what the attribute must leave alone")]

use pineda::{Bool, Fragment, Lanes, OutputKind, Outputs, Real, Rgba, Scalar, Shader, Uint, Vec3, Vec4, shader};

/// A whole module at once: a shader, its helpers, an inner module, and attributes that are there already.
#[shader]
mod shaders {
    use super::*;

    pub struct Toon {
        pub steps: Vec<f32>,
    }

    #[shader]
    impl Shader for Toon {
        type Vertex = [f32; 3];
        type Varyings<L: Lanes> = Vec3<L>;

        fn vertex(&self, position: &[f32; 3]) -> (Vec4, Vec3) {
            (Vec3::from(*position).extend(1.0), (*position).into())
        }

        fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
            Rgba::opaque(f.varyings() * self.level(f.z()))
        }
    }

    impl Toon {
        #[inline]
        pub fn level<L: Lanes>(&self, light: Real<L>) -> Real<L> {
            let above = |edge: f32| light.gt(edge);
            let mut level = Real::new(light.lanes(), 0.0);
            for &edge in &self.steps {
                level += above(edge).select(inner::STEP, 0.0);
            }
            level
        }
    }

    mod inner {
        pub(super) const STEP: f32 = 0.25;
    }
}

/// What the fragment stage returns is read from it, whatever its width is called, or said.
struct Read;

#[shader]
impl Shader for Read {
    type Vertex = ();
    type Varyings<L: Lanes> = ();
    fn vertex(&self, (): &()) -> (Vec4, ()) {
        Default::default()
    }
    fn fragment<Width: Lanes>(&self, f: &mut Fragment<Width, Self>) -> (Rgba<Width>, Uint<Width>) {
        (Rgba::gray(f.z()), f.splat(7u32))
    }
}

struct Said;

#[shader]
impl Shader for Said {
    type Vertex = ();
    type Varyings<L: Lanes> = ();
    type Output<L: Lanes> = [Real<L>; 2];
    fn vertex(&self, (): &()) -> (Vec4, ()) {
        Default::default()
    }
    fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Self::Output<L> {
        [f.x(), f.y()]
    }
}

#[test]
fn outputs_are_read_from_the_signature_or_said() {
    fn kinds<Sh: Shader>(_: Sh) -> &'static [OutputKind] {
        <Sh::Output<Scalar> as Outputs<Scalar>>::KINDS
    }
    assert_eq!(kinds(Read), [OutputKind::Float, OutputKind::Uint]);
    assert_eq!(kinds(Said), [OutputKind::Float; 2]);
    assert_eq!(kinds(shaders::Toon { steps: Vec::new() }), [OutputKind::Float]);
}

/// A trait with a default method, and an implementation.
#[shader]
trait Tint<L: Lanes> {
    fn strength(&self, at: Real<L>) -> Real<L>;
    fn tint(&self, at: Real<L>) -> Real<L> {
        self.strength(at) * 0.5
    }
}

#[shader]
impl<L: Lanes> Tint<L> for f32 {
    fn strength(&self, at: Real<L>) -> Real<L> {
        at.powf(*self)
    }
}

/// Closures: passed to a function of one's own, and bound with `let`.
#[shader]
fn twice<L: Lanes>(x: Real<L>, function: impl Fn(Real<L>) -> Real<L>) -> Real<L> {
    function(function(x))
}

#[shader]
fn closures<L: Lanes>(x: Real<L>) -> Real<L> {
    let half = |x: Real<L>| x * 0.5;
    twice(x, |x| x + 1.0) + half(x)
}

/// `const` and generics stay as they are.
#[shader]
const fn index<const N: usize>(i: usize) -> usize {
    i % N
}

#[shader]
fn inside<L: Lanes>(x: Real<L>) -> Bool<L> {
    x.gt(-1.0) & x.lt(1.0) & !x.eq(0.0)
}

/// Functions of their own: the lanes are those of the first argument, or of what is named.
#[shader(apart)]
fn cube<L: Lanes>(x: Real<L>) -> Real<L> {
    if L::N == 0 {
        return x;
    }
    x * x * x
}

struct Line(f32);

#[shader]
impl Line {
    #[shader(apart(at.x))]
    fn height<L: Lanes>(&self, mut at: Vec3<L>) -> Real<L> {
        at.x *= self.0;
        at.x
    }
}

#[test]
fn functions_of_their_own_return_what_they_would_inlined() {
    assert_eq!(cube(Real::<Scalar>::from(3.0)), 27.0.into());
    assert_eq!(Line(0.5).height(Vec3::<Scalar>::from([3.0, 0.0, 0.0])), 1.5.into());
}

#[test]
fn modules_traits_functions_and_closures_do_what_they_say() {
    let toon = shaders::Toon { steps: vec![0.1, 0.5, 0.9] };
    assert_eq!(toon.level(Real::<Scalar>::from(0.6)), 0.5.into());
    assert_eq!(toon.vertex(&[1.0, 2.0, 3.0]), ([1.0, 2.0, 3.0, 1.0].into(), [1.0, 2.0, 3.0].into()));
    assert_eq!(2.0_f32.tint(Real::<Scalar>::from(3.0)), 4.5.into());
    assert_eq!(closures(Real::<Scalar>::from(4.0)), 8.0.into());
    assert_eq!(index::<3>(7), 1);
    assert!(bool::from(inside(Real::<Scalar>::from(0.5))) && !bool::from(inside(Real::<Scalar>::from(0.0))));
}
