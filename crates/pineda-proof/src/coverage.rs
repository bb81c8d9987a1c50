//! Is every pixel covered as often as the oracle says?
//!
//! In raster space every pixel must be right, for a snapped position is exact. In clip space the projection rounds, and a
//! snapped corner may lie up to half a subpixel from where it was asked to be, in x and in y: there the oracle knows the exact triangle,
//! before snapping, and within [`MARGIN`] of its edges either answer can be right. Where it can tell what a corner snaps to, it
//! must be right at every pixel again.

use crate::{Drawing, Tally};
use pineda_oracle::cases::{Case, Space};
use pineda_oracle::{Triangle, Visible, covered_exactly_once, hits, project_snapped};

/// Pixels: sqrt(2) / 512 for a snapped corner (0.0028), and as much again as the picture leaves for the rounding of a cut before it.
pub(crate) const MARGIN: f64 = 1.0 / 256.0;

/// How far off a projected coordinate may be before it is snapped, in pixels; f64 is better by far in a picture of 96 pixels.
const PROJECTION: f64 = 1.0 / 1_048_576.0;

/// Compares the hits of a drawing with the oracle's.
pub(crate) fn judge(case: &Case, drawing: &Drawing, tally: &mut Tally) -> Result<(), String> {
    tally.pixels += drawing.hits.len() as u64;
    tally.hits += drawing.hits.iter().map(|&hits| u64::from(hits)).sum::<u64>();
    if drawing.statistics.non_finite != case.dropped() as u64 {
        return Err(format!("{} triangles were dropped instead of {}", drawing.statistics.non_finite, case.dropped()));
    }
    match case.space {
        Space::Raster => raster(case, drawing),
        Space::Clip => clip(case, drawing, tally),
    }
}

/// Clipping computes in f64. Where the sizes of a triangle's coordinates lie further apart than this (no camera makes such a triangle), its
/// cuts can be off by more than a subpixel; then all that is asked is that drawing it does no harm.
pub(crate) const SPAN: f64 = 18_446_744_073_709_551_616.0;

/// The largest quotient of two coordinates' sizes, zeros left out.
pub(crate) fn span(triangles: &[[[f32; 4]; 3]]) -> f64 {
    let sizes = || triangles.iter().flatten().flatten().map(|x| f64::from(x.abs())).filter(|&x| x > 0.0);
    sizes().fold(0.0, f64::max) / sizes().fold(f64::INFINITY, f64::min)
}

/// The snapped corners of a clip-space triangle, if they are certain and the triangle needs no clipping, nor any other care.
pub(crate) fn certain(case: &Case, corners: [[f32; 4]; 3]) -> Option<Triangle> {
    const GUARD_BAND: i64 = pineda_oracle::cases::GUARD_BAND;
    let mut snapped = [[0; 2]; 3];
    for (snapped, corner) in snapped.iter_mut().zip(corners) {
        let [_, _, z, w] = corner;
        // Beyond 2^64 and 2^-64, `pineda` takes a corner the careful way, in f64 and from where it was asked to be.
        let is_in_view = w > 0.0 && (0.0..=w).contains(&z) && (SPAN.recip()..=SPAN).contains(&(1.0 / f64::from(w)));
        *snapped = project_snapped(corner, case.width, case.height, PROJECTION)
            .filter(|point| is_in_view && point.iter().all(|x| x.abs() <= GUARD_BAND))?;
    }
    Some(snapped)
}

fn raster(case: &Case, drawing: &Drawing) -> Result<(), String> {
    same(&drawing.hits, &case.hits(), case.width)?;
    if case.outline.is_empty() { Ok(()) } else { covered_exactly_once(&drawing.hits, &case.region(), case.width) }
}

fn clip(case: &Case, drawing: &Drawing, tally: &mut Tally) -> Result<(), String> {
    let triangles: Vec<_> = case.corners().filter(|corners| corners.iter().flatten().all(|x| x.is_finite())).collect();
    let snapped: Option<Vec<_>> = triangles.iter().map(|&corners| certain(case, corners)).collect();
    if let Some(snapped) = snapped {
        tally.certain += 1;
        return same(&drawing.hits, &hits(&snapped, case.width, case.height), case.width);
    }
    if span(&triangles) > SPAN {
        tally.doubtful += 1;
        return Ok(());
    }
    let visible = |corners: &[[f32; 4]]| Visible::new(corners, case.width, case.height);
    let parts: Vec<Visible> = if case.outline.is_empty() {
        triangles.iter().filter_map(|corners| visible(corners)).collect()
    } else {
        let outline: Vec<_> = case.outline.iter().map(|&k| case.vertices[k as usize]).collect();
        visible(&outline).into_iter().collect()
    };
    for (at, &found) in drawing.hits.iter().enumerate() {
        let pixel = [at as i64 % i64::from(case.width), at as i64 / i64::from(case.width)];
        let wanted = parts.iter().filter(|part| part.covers(pixel)).count() as u32;
        if found != wanted {
            let margins: Vec<f64> = parts.iter().map(|part| part.margin(pixel)).collect();
            let doubtful = margins.iter().filter(|margin| margin.abs() <= MARGIN).count() as u32;
            if found.abs_diff(wanted) > doubtful {
                return Err(format!(
                    "pixel {pixel:?} is hit {found} times instead of {wanted}, {margins:?} px from edges"
                ));
            }
            tally.doubtful += 1;
        }
    }
    Ok(())
}

fn same(found: &[u32], wanted: &[u32], width: u32) -> Result<(), String> {
    match found.iter().zip(wanted).position(|(found, wanted)| found != wanted) {
        None => Ok(()),
        Some(at) => {
            let (i, j) = (at % width as usize, at / width as usize);
            Err(format!("pixel ({i}, {j}) is hit {} times instead of {}", found[at], wanted[at]))
        }
    }
}
