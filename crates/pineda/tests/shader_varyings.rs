//! Structs as varyings: taken apart, put together again, and labelled with how each number is interpolated.

#![allow(missing_docs, reason = "a test's types")]

use pineda::Interpolation::{Flat, NoPerspective, Perspective};
use pineda::{Lanes, Real, Rgba, Scalar, Varyings, Vec2, Vec3, Vec4, varyings};

varyings! {
    /// A field of each kind, and a struct in the struct.
    pub struct Everything {
        pub one: Real,
        #[flat]
        pub two: Vec2,
        /// Documented.
        #[noperspective]
        three: Vec3,
        four: Vec4,
        color: Rgba,
        inner: Inner,
        #[flat]
        frozen: Inner,
    }
}

varyings! {
    pub struct Inner { #[noperspective] a: Real, b: Real }
}

/// Written out: another name for the width, a tuple struct, a bound in a where clause.
#[derive(Varyings, Debug)]
pub struct Pair<Width = Scalar>(Vec2<Width>, #[flat] Real<Width>)
where
    Width: Lanes;

fn numbers<const N: usize>() -> [f32; N] {
    std::array::from_fn(|i| i as f32)
}

#[test]
fn structs_are_rows_of_numbers_in_the_order_of_their_fields() {
    const LEN: usize = <Everything as Varyings<Scalar>>::LEN;
    assert_eq!(LEN, 1 + 2 + 3 + 4 + 4 + 2 + 2);
    let row = numbers::<LEN>();
    let value = <Everything as Varyings<Scalar>>::read(Scalar, &row);
    assert_eq!(value.one, 0.0.into());
    assert_eq!(value.two, [1.0, 2.0].into());
    assert_eq!(value.three, [3.0, 4.0, 5.0].into());
    assert_eq!(value.four, [6.0, 7.0, 8.0, 9.0].into());
    assert_eq!(value.color, [10.0, 11.0, 12.0, 13.0].into());
    assert_eq!([value.inner.a, value.inner.b], [14.0.into(), 15.0.into()]);
    assert_eq!([value.frozen.a, value.frozen.b], [16.0.into(), 17.0.into()]);

    let mut back = [-1.0; LEN];
    value.write(&mut back);
    assert_eq!(back, row);
}

#[test]
fn attributes_say_how_each_number_is_interpolated() {
    let mut expected = vec![Perspective, Flat, Flat, NoPerspective, NoPerspective, NoPerspective];
    expected.extend([Perspective; 8]);
    expected.extend([NoPerspective, Perspective]);
    expected.extend([Flat, Flat]);
    assert_eq!(<Everything as Varyings<Scalar>>::INTERPOLATION, expected);
}

#[test]
fn tuple_structs_and_where_clauses_are_derived_too() {
    assert_eq!(<Pair as Varyings<Scalar>>::INTERPOLATION, [Perspective, Perspective, Flat]);
    let pair = <Pair as Varyings<Scalar>>::read(Scalar, &numbers::<3>());
    let copy = pair;
    assert_eq!((pair.0, copy.1), ([0.0, 1.0].into(), 2.0.into()));
    let mut row = numbers::<4>();
    Pair(copy.0 + 10.0, copy.1).write(&mut row);
    assert_eq!(row, [10.0, 11.0, 2.0, 3.0]);
}

#[test]
fn varyings_may_be_a_number_a_vector_or_nothing() {
    assert_eq!(<() as Varyings<Scalar>>::LEN, 0);
    <() as Varyings<Scalar>>::read(Scalar, &[]);
    assert_eq!(<Real as Varyings<Scalar>>::LEN, 1);
    assert_eq!(<Vec2 as Varyings<Scalar>>::LEN, 2);
    assert_eq!(<Vec3 as Varyings<Scalar>>::LEN, 3);
    assert_eq!(<Vec4 as Varyings<Scalar>>::LEN, 4);
    assert_eq!(<Rgba as Varyings<Scalar>>::LEN, 4);
}

#[test]
fn thirty_two_numbers_fit() {
    varyings! { struct Most { a: Vec4, b: Vec4, c: Vec4, d: Vec4, e: Vec4, f: Vec4, g: Vec4, h: Vec4 } }
    assert_eq!(<Most as Varyings<Scalar>>::LEN, pineda::MAX_VARYINGS);
}

/// They had been whatever an earlier packet left in its rows.
#[test]
fn derivatives_of_flat_varyings_are_zero() -> Result<(), pineda::Error> {
    use pineda::*;
    varyings! { struct Steep { slope: Vec3 } }
    varyings! { struct Level { #[flat] level: Vec3 } }
    struct First;
    struct Second;
    #[shader]
    impl Shader for First {
        type Vertex = [f32; 2];
        type Varyings<L: Lanes> = Steep<L>;
        const DERIVATIVES: bool = true;
        fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Steep) {
            ([x, y, 0.5, 1.0].into(), Steep { slope: [x, y, x - y].into() })
        }
        fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
            Rgba::opaque(f.dx().slope)
        }
    }
    #[shader]
    impl Shader for Second {
        type Vertex = [f32; 2];
        type Varyings<L: Lanes> = Level<L>;
        const DERIVATIVES: bool = true;
        fn vertex(&self, &[x, y]: &[f32; 2]) -> (Vec4, Level) {
            ([x, y, 0.5, 1.0].into(), Level { level: [x, y, 7.0].into() })
        }
        fn fragment<L: Lanes>(&self, f: &mut Fragment<L, Self>) -> Rgba<L> {
            Rgba::opaque(f.dual().level.fwidth() + f.dx().level + f.dy().level)
        }
    }
    let triangle = [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]];
    let mesh = Mesh { vertices: &triangle, indices: Indices::Sequential };
    let mut pass = Pass::new();
    pass.draw(&First, mesh, DrawState::default());
    pass.draw(&Second, mesh, DrawState { depth: DepthState::OFF, ..DrawState::default() });
    let mut pixels = vec![[1.0; 4]; 32 * 32];
    let mut target = Target { color: ColorBuffer::Rgba32F(&mut pixels), ..Target::new(32, 32) };
    Renderer::new(Settings { threads: 1, ..Settings::default() })?.render(&pass, &mut target)?;
    assert!(pixels.iter().all(|&pixel| pixel == [0.0, 0.0, 0.0, 1.0]), "{:?}", pixels[0]);
    Ok(())
}
