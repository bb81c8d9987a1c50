//! The oracle's lines and points against what one can see, and against each other.

#![allow(missing_docs, reason = "a test")]

use pineda_oracle::cases::Random;
use pineda_oracle::{Line, Rational, covered_area, line_coverage, line_covers, picture, point_covers};

fn drawn(line: Line) -> String {
    picture(&line_coverage(line, 6, 4), 6)
}

/// The middle of pixel (i, j).
const fn at(i: i64, j: i64) -> [i64; 2] {
    [256 * i + 128, 256 * j + 128]
}

#[test]
fn lines_between_centres_own_their_first_pixel_and_not_their_last() {
    assert_eq!(drawn([at(1, 1), at(4, 1)]), "......\n.###..\n......\n......\n");
    assert_eq!(drawn([at(4, 1), at(1, 1)]), "......\n..###.\n......\n......\n");
    assert_eq!(drawn([at(2, 0), at(2, 3)]), "..#...\n..#...\n..#...\n......\n");
    assert_eq!(drawn([at(2, 3), at(2, 0)]), "......\n..#...\n..#...\n..#...\n");
    assert_eq!(drawn([at(0, 0), at(3, 3)]), "#.....\n.#....\n..#...\n......\n");
    assert_eq!(drawn([at(5, 0), at(2, 3)]), ".....#\n....#.\n...#..\n......\n");
}

#[test]
fn what_leaves_no_diamond_owns_nothing() {
    for p in [at(1, 1), [256, 256], [300, 500], [384, 256]] {
        assert!(!drawn([p, p]).contains('#'), "no length at {p:?}");
    }
    assert!(!drawn([[370, 380], [390, 400]]).contains('#'), "all within one diamond");
    assert_eq!(drawn([at(1, 1), [385, 513]]), "......\n.#....\n......\n......\n", "it just leaves the diamond");
}

#[test]
fn lines_along_borders_belong_to_the_pixels_on_their_upper_left() {
    // As the top-left rule has it: moved up and left, the line lies in the pixels above it, left of it.
    assert_eq!(drawn([[256, 512], [1024, 512]]), "......\n.###..\n......\n......\n");
    assert_eq!(drawn([[512, 256], [512, 768]]), "......\n.#....\n.#....\n......\n");
}

#[test]
fn a_slope_of_one_along_the_diamonds_borders() {
    // Along the lower left borders of some and the upper right ones of others; moved left, it lies in these.
    assert_eq!(drawn([[256, 384], [896, 1024]]), "......\n#.....\n.#....\n..#...\n");
    assert_eq!(drawn([[384, 256], [1152, 1024]]), "......\n.#....\n..#...\n...#..\n");
}

#[test]
fn a_strip_hits_no_pixel_twice_at_a_joint_that_goes_on() {
    // Going right and down: each column's pixels are owned once, whatever the joints.
    let mut random = Random::new(7);
    for _ in 0..300 {
        let mut p = [random.between(-300, 300), random.between(-300, 300)];
        let mut hits = vec![0; 24];
        let mut whole = vec![0; 24];
        let step = [random.between(1, 40), random.between(0, 40)];
        let (first, count) = (p, random.between(1, 60));
        for _ in 0..count {
            let q = [p[0] + step[0], p[1] + step[1]];
            hits.iter_mut().zip(line_coverage([p, q], 6, 4)).for_each(|(hits, inside)| *hits += u32::from(inside));
            p = q;
        }
        whole.iter_mut().zip(line_coverage([first, p], 6, 4)).for_each(|(hits, inside)| *hits += u32::from(inside));
        assert_eq!(hits, whole, "{count} steps of {step:?} from {first:?} are the same line as one");
    }
}

#[test]
fn lines_of_any_length_own_one_pixel_for_each_step_of_their_longer_extent() {
    let mut random = Random::new(11);
    for _ in 0..2_000 {
        let coordinate = |random: &mut Random| {
            if random.one_in(3) { 128 * random.between(-4, 16) } else { random.between(-500, 2_000) }
        };
        let [a, b] = [0; 2].map(|_| [coordinate(&mut random), coordinate(&mut random)]);
        let covered = line_coverage([a, b], 6, 4);
        let is_x_major = (b[0] - a[0]).abs() >= (b[1] - a[1]).abs();
        for k in 0..if is_x_major { 6 } else { 4 } {
            let line = (0..24).filter(|at| if is_x_major { at % 6 == k } else { at / 6 == k });
            let count = line.filter(|&at: &usize| covered[at]).count();
            assert!(count <= 1, "{a:?} to {b:?} owns {count} pixels of column or row {k}");
        }
    }
}

#[test]
fn the_guard_band_is_no_limit() {
    let far = 1 << 23;
    assert!(line_covers([[-far, -far], [far, far]], [3, 3]));
    assert!(!line_covers([[-far, -far], [far, far]], [3, 4]));
    assert!(line_covers([[-far, 128], [far, 129]], [3, 0]));
    // At the middle it is on the border of two rows, and rises: just above of it, just below.
    assert!(line_covers([[-far, 511], [far, 513]], [0, 2]) && line_covers([[-far, 511], [far, 513]], [-1, 1]));
}

#[test]
fn points_own_their_left_and_top_border() {
    let owns = |middle, size| -> usize {
        (0..6).flat_map(|i| (0..4).map(move |j| [i, j])).filter(|&pixel| point_covers(middle, size, pixel)).count()
    };
    assert_eq!(owns(at(2, 1), 256), 1);
    assert_eq!(owns([512, 512], 256), 1, "on the corner of four pixels it owns the lower right one's centre");
    assert!(point_covers([512, 512], 256, [1, 1]));
    assert_eq!(owns([512, 512], 512), 4);
    assert_eq!(owns(at(2, 1), 1), 1);
    assert_eq!(owns(at(2, 1), 0), 0);
}

#[test]
fn areas_one_can_see() {
    let part = |corners: &[[i64; 2]], pixel| covered_area(corners, pixel).to_f64().value();
    let square = [[128, 64], [640, 64], [640, 512], [128, 512]];
    assert_eq!(
        [[0, 0], [1, 0], [2, 0], [1, 1], [0, 2]].map(|pixel| part(&square, pixel)),
        [0.375, 0.75, 0.375, 1.0, 0.0]
    );
    let diamond = [[256, 0], [512, 256], [256, 512], [0, 256]];
    assert!([[0, 0], [1, 0], [0, 1], [1, 1]].iter().all(|&pixel| part(&diamond, pixel) == 0.5));
    assert!([[2, 0], [-1, 1]].iter().all(|&pixel| covered_area(&diamond, pixel) == Rational::ZERO));
}
