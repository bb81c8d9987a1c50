//! The nodes of the scene, from its roots to its leaves.

use super::schema::{Node, Root, Whole};
use super::transform::Affine;
use crate::Error;

/// Calls `visit` with each node of a scene that has a mesh, its mesh's number and its world transform;
/// parents before children, children in their order.
///
/// In a file without scenes these are all nodes that are nobody's child. glTF's nodes form trees: a node that comes up twice (a cycle, two parents) is an error, and so nothing here runs for ever.
pub(super) fn for_each_mesh(
    root: &Root,
    scene: usize,
    deepest: u64,
    mut visit: impl FnMut(&Node, usize, Affine) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut seen = vec![false; root.nodes.len()];
    let mut stack: Vec<(Whole, u64, Affine)> =
        scene_roots(root, scene).into_iter().rev().map(|node| (node, 0, Affine::IDENTITY)).collect();
    while let Some((number, depth, parent)) = stack.pop() {
        let wrong = |message: &str| Err(Error::gltf(format!("node {number}"), message));
        let Some(node) = root.nodes.get(number.index()) else {
            return wrong("a scene or node names it, but it does not exist");
        };
        if std::mem::replace(&mut seen[number.index()], true) {
            return wrong("it is in the scene twice, or its own ancestor; nodes must form trees");
        }
        if depth > deepest {
            return Err(Error::Limit {
                what: "nodes above a node",
                count: depth,
                limit: deepest,
                field: "Limits::nesting",
            });
        }
        let world = parent.after(&Affine::of_node(node));
        if let Some(mesh) = node.mesh {
            if mesh.index() >= root.meshes.len() {
                return wrong(&format!("its mesh {mesh} does not exist"));
            }
            visit(node, mesh.index(), world)?;
        }
        stack.extend(node.children.iter().rev().map(|&child| (child, depth + 1, world)));
    }
    Ok(())
}

fn scene_roots(root: &Root, scene: usize) -> Vec<Whole> {
    if let Some(scene) = root.scenes.get(scene) {
        return scene.nodes.to_vec();
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter()) {
        if let Some(is_child) = is_child.get_mut(child.index()) {
            *is_child = true;
        }
    }
    (0..).map(Whole).zip(is_child).filter(|&(_, is_child)| !is_child).map(|(node, _)| node).collect()
}
