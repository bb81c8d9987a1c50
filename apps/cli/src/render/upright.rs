//! What `--up` says becomes +y: the studio's light comes from there, and the ground lies across it.

use pineda_scene::{Framing, Scene};

/// Turns a scene and the camera before it by the smallest rotation that leads from `up` to +y: the picture is the same.
pub(crate) fn turn(scene: &mut Scene, framing: &mut Framing, up: [f64; 3]) {
    if up[0] == 0.0 && up[1] > 0.0 && up[2] == 0.0 {
        return;
    }
    let rows = rotation(up);
    let turned = |v: [f64; 3]| rows.map(|row| (0..3).map(|axis| row[axis] * v[axis]).sum::<f64>());
    let turned32 = |v: [f32; 3]| turned(v.map(f64::from)).map(|x| x as f32);
    for object in &mut scene.objects {
        for vertex in &mut object.vertices {
            (vertex.position, vertex.normal) = (turned32(vertex.position), turned32(vertex.normal));
        }
        for tangent in &mut object.tangents {
            let [x, y, z, side] = *tangent;
            let [x, y, z] = turned32([x, y, z]);
            *tangent = [x, y, z, side];
        }
    }
    for light in &mut scene.lights {
        (light.position, light.direction) = (turned(light.position), turned(light.direction));
    }
    (framing.eye, framing.target, framing.up) = (turned(framing.eye), turned(framing.target), turned(framing.up));
}

/// The rows of the matrix that turns the direction `up`, not 0, to +y (Möller and Hughes 1999, "Efficiently building a matrix to rotate one vector to another").
fn rotation(up: [f64; 3]) -> [[f64; 3]; 3] {
    let length = up.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z] = up.map(|x| x / length);
    if y < -1.0 + 1e-12 {
        return [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    }
    let h = 1.0 / (1.0 + y);
    [[1.0 - h * x * x, -x, -h * x * z], [x, y, z], [-h * x * z, -z, 1.0 - h * z * z]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const Y: [f64; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn rotations_lead_up_to_y_and_keep_lengths_and_hands() {
        let ups = [Y, [0.0, 0.0, 1.0], [0.0, 0.0, -2.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, -0.9, 2.0]];
        for up in ups {
            let rows = rotation(up);
            let turned = |v: [f64; 3]| rows.map(|row| (0..3).map(|axis| row[axis] * v[axis]).sum::<f64>());
            let length = up.iter().map(|x| x * x).sum::<f64>().sqrt();
            let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
            assert!(near(turned(up), Y.map(|y| y * length)), "{up:?}");
            let [a, b, c] = rows;
            let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            assert!(near(cross, c), "{up:?}: {rows:?}");
        }
    }
}
