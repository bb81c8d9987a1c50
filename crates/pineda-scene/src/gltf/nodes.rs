//! The nodes of a scene, from its roots to its leaves, and where they are.

use super::animation::AnimatedNodes;
use super::schema::{Root, Whole};
use super::transform::Affine;
use crate::Error;

/// Where the nodes are in one pose.
pub(super) struct Nodes<'a> {
    root: &'a Root,
    animated: &'a AnimatedNodes,
    /// Each node's transform, once it is known.
    world: Vec<Option<Affine>>,
    deepest: u64,
}

impl<'a> Nodes<'a> {
    /// The nodes of a scene, parents before children, children in their order. In a file without scenes these are all
    /// nodes, from those on that are nobody's child.
    ///
    /// glTF's nodes form trees: a node that comes up twice (a cycle, two parents) is an error, and so nothing here runs
    /// for ever.
    pub(super) fn of_scene(
        root: &'a Root,
        animated: &'a AnimatedNodes,
        scene: usize,
        deepest: u64,
    ) -> Result<(Self, Vec<usize>), Error> {
        let mut this = Self { root, animated, world: vec![None; root.nodes.len()], deepest };
        let mut order = Vec::new();
        let roots = match root.scenes.get(scene) {
            Some(scene) => scene.nodes.to_vec(),
            None => nobodys_children(root),
        };
        let mut stack: Vec<(Whole, u64, Affine)> =
            roots.into_iter().rev().map(|node| (node, 0, Affine::IDENTITY)).collect();
        while let Some((number, depth, parent)) = stack.pop() {
            let wrong = |message: &str| Err(Error::gltf(format!("node {number}"), message));
            let Some(node) = root.nodes.get(number.index()) else {
                return wrong("a scene or node names it, but it does not exist");
            };
            if this.world[number.index()].is_some() {
                return wrong("it is in the scene twice, or its own ancestor; nodes must form trees");
            }
            this.check_depth(depth)?;
            let world = parent.after(&this.local(number.index()));
            this.world[number.index()] = Some(world);
            order.push(number.index());
            stack.extend(node.children.iter().rev().map(|&child| (child, depth + 1, world)));
        }
        Ok((this, order))
    }

    /// Where a node of the scene is, or any other that the scene's need, such as the joints of a skin.
    pub(super) fn world(&self, node: usize) -> Option<Affine> {
        self.world.get(node).copied().flatten()
    }

    /// Finds where these nodes are that are not in the scene.
    pub(super) fn complete(&mut self, others: impl Iterator<Item = usize>) -> Result<(), Error> {
        let missing: Vec<usize> = others.filter(|&node| self.world.get(node).is_some_and(Option::is_none)).collect();
        if missing.is_empty() {
            return Ok(());
        }
        let mut parent_of = vec![None; self.root.nodes.len()];
        for (parent, node) in self.root.nodes.iter().enumerate() {
            for child in node.children.iter() {
                if let Some(parent_of) = parent_of.get_mut(child.index()) {
                    *parent_of = Some(parent);
                }
            }
        }
        for node in missing {
            let mut path = Vec::new();
            let mut next = Some(node);
            let mut world = Affine::IDENTITY;
            while let Some(node) = next {
                if let Some(known) = self.world[node] {
                    world = known;
                    break;
                }
                // Also ends a cycle.
                self.check_depth(path.len() as u64)?;
                path.push(node);
                next = parent_of[node];
            }
            for node in path.into_iter().rev() {
                world = world.after(&self.local(node));
                self.world[node] = Some(world);
            }
        }
        Ok(())
    }

    fn local(&self, node: usize) -> Affine {
        Affine::of_node(&self.root.nodes[node], self.animated.get(&node))
    }

    fn check_depth(&self, depth: u64) -> Result<(), Error> {
        if depth <= self.deepest {
            return Ok(());
        }
        Err(Error::Limit { what: "nodes above a node", count: depth, limit: self.deepest, field: "Limits::nesting" })
    }
}

fn nobodys_children(root: &Root) -> Vec<Whole> {
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter()) {
        if let Some(is_child) = is_child.get_mut(child.index()) {
            *is_child = true;
        }
    }
    (0..).map(Whole).zip(is_child).filter(|&(_, is_child)| !is_child).map(|(node, _)| node).collect()
}
