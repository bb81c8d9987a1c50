//! Does each triangle touch, and cover whole, the pixels that the oracle says?
//!
//! In raster space, and where snapped corners are certain, exactly. For other triangles of clip space there are bounds: a pixel is certainly touched if a corner of it lies
//! well inside of the exact triangle, and certainly not if all of it lies well outside of an edge; it is certainly covered whole if all of its corners lie well inside,
//! and certainly not if one of them lies well outside.

use crate::coverage::{MARGIN, SPAN, certain, span};
use crate::{Drawing, Renderers, Tally, draw_case};
use pineda::{Conservative, DrawState};
use pineda_oracle::cases::{Case, Random, Space};
use pineda_oracle::{SUBPIXELS, Triangle, Visible, covers_whole, touches};

/// Draws a case with either setting, twice, and compares the hits with the oracle's, and what is covered ordinarily, too, with the ordinary drawing.
pub(crate) fn judge(
    case: &Case,
    ordinary: &Drawing,
    renderers: &mut Renderers,
    random: &mut Random,
    tally: &mut Tally,
) -> Result<(), String> {
    let bounds = bounds(case);
    for (mode, conservative) in [Conservative::Overestimate, Conservative::Underestimate].into_iter().enumerate() {
        let mut drawn = || {
            let (settings, order) = (random.bits(), random.between(0, 5) as usize);
            draw_case(renderers.nth(settings), case, order, DrawState { conservative, ..DrawState::default() })
        };
        let (drawing, repeat) = (drawn()?, drawn()?);
        tally.conservative += drawing.hits.len() as u64;
        if let Some(difference) = drawing.difference(&repeat) {
            return Err(format!("{conservative:?}: two settings or orders differ: {difference}"));
        }
        let problem = bounds.as_ref().map_or(Ok(()), |bounds| within(&drawing, &bounds[mode]));
        problem
            .and_then(|()| agrees(case, &drawing, ordinary, conservative))
            .map_err(|problem| format!("{conservative:?}: {problem}"))?;
    }
    Ok(())
}

/// For each pixel, how many triangles hit it at least and at most.
type Bounds = Vec<[u32; 2]>;

/// Those of overestimation and of underestimation; `None` if nobody can say.
fn bounds(case: &Case) -> Option<[Bounds; 2]> {
    let mut bounds = [(); 2].map(|()| vec![[0; 2]; (case.width * case.height) as usize]);
    let triangles: Vec<_> = case.corners().filter(|corners| corners.iter().flatten().all(|x| x.is_finite())).collect();
    let snapped: Option<Vec<Triangle>> = match case.space {
        Space::Raster => Some(case.snapped()),
        Space::Clip => triangles.iter().map(|&corners| certain(case, corners)).collect(),
    };
    if let Some(snapped) = snapped {
        for triangle in snapped {
            for_each_near(triangle, case, |pixel, at| {
                for (bounds, hits) in bounds.iter_mut().zip([touches, covers_whole]) {
                    bounds[at] = bounds[at].map(|count| count + u32::from(hits(triangle, pixel)));
                }
            });
        }
        return Some(bounds);
    }
    if span(&triangles) > SPAN {
        return None;
    }
    for part in triangles.iter().filter_map(|corners| Visible::new(corners, case.width, case.height)) {
        let edges = part.corner_margins();
        let [over, under] = &mut bounds;
        for (at, (over, under)) in over.iter_mut().zip(under).enumerate() {
            let [x, y] = [at % case.width as usize, at / case.width as usize];
            let Some(edges) = &edges else {
                (over[1], under[1]) = (over[1] + 1, under[1] + 1);
                continue;
            };
            let first = y * (case.width as usize + 1) + x;
            let corners = [first, first + 1, first + case.width as usize + 1, first + case.width as usize + 2];
            let margin = |corner: usize| edges.iter().map(|edge| edge[corner]).fold(f64::INFINITY, f64::min);
            let is_apart = edges.iter().any(|edge| corners.iter().all(|&corner| edge[corner] < -MARGIN));
            over[0] += u32::from(corners.iter().any(|&corner| margin(corner) > MARGIN));
            over[1] += u32::from(!is_apart);
            under[0] += u32::from(corners.iter().all(|&corner| margin(corner) > MARGIN));
            under[1] += u32::from(!corners.iter().any(|&corner| margin(corner) < -MARGIN));
        }
    }
    Some(bounds)
}

/// The pixels of a picture that a triangle's bounding box comes near, and their indices.
fn for_each_near(triangle: Triangle, case: &Case, mut visit: impl FnMut([i64; 2], usize)) {
    let span = |axis: usize, size: u32| {
        let of = |pick: fn(i64, i64) -> i64| triangle.iter().map(|p| p[axis]).fold(triangle[0][axis], pick);
        let (low, high) = (of(i64::min).div_euclid(SUBPIXELS), of(i64::max).div_euclid(SUBPIXELS));
        (low - 1).max(0)..(high + 2).min(size.into())
    };
    for j in span(1, case.height) {
        for i in span(0, case.width) {
            visit([i, j], (j * i64::from(case.width) + i) as usize);
        }
    }
}

fn within(drawing: &Drawing, bounds: &[[u32; 2]]) -> Result<(), String> {
    match drawing.hits.iter().zip(bounds).position(|(hits, [least, most])| !(least..=most).contains(&hits)) {
        None => Ok(()),
        Some(at) => {
            let (i, j) = (at % drawing.width as usize, at / drawing.width as usize);
            Err(format!("pixel ({i}, {j}) is hit {} times instead of {:?}", drawing.hits[at], bounds[at]))
        }
    }
}

/// What is covered whole is covered, and what is covered is touched; and of one triangle that is not clipped the same bits.
fn agrees(case: &Case, drawing: &Drawing, ordinary: &Drawing, conservative: Conservative) -> Result<(), String> {
    let (more, fewer) =
        if conservative == Conservative::Overestimate { (drawing, ordinary) } else { (ordinary, drawing) };
    if let Some(at) = more.hits.iter().zip(&fewer.hits).position(|(more, fewer)| more < fewer) {
        let hits = [drawing.hits[at], ordinary.hits[at]];
        return Err(format!(
            "pixel {at} of a row of {}: hit {hits:?} times, conservatively and ordinarily",
            case.width
        ));
    }
    if case.triangles.len() != 1 || drawing.statistics.clipped > 0 {
        return Ok(());
    }
    let mut alike = drawing.clone();
    for at in (0..fewer.hits.len()).filter(|&at| fewer.hits[at] == 0) {
        alike.take(ordinary, at);
    }
    alike.difference(ordinary).map_or(Ok(()), |difference| Err(format!("other bits than ordinarily: {difference}")))
}
