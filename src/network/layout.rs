//! A line cut into nodes and the bars between them.

use crate::scene::{ElementIndex, End, Kind, Scene};

/// What a node has on one side.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Side {
    /// A bar, by its place in the line.
    Bar(usize),
    /// No force.
    Free,
    /// No motion.
    Fixed,
}

/// The elements between two bars, or between a bar and an end.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Node {
    pub left: Side,
    /// Lumped elements from left to right.
    pub elements: Vec<ElementIndex>,
    pub right: Side,
}

/// A run of places in a node that move together, or that pass the same force on: from the first
/// place to the last. Place `i` is left of the i-th element.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Run {
    pub first: usize,
    pub last: usize,
}

impl Node {
    /// What a run of places has at its ends: the sides of the node that it reaches.
    pub fn sides(&self, run: Run) -> impl Iterator<Item = Side> {
        let left = (run.first == 0).then_some(self.left);
        let right = (run.last == self.elements.len()).then_some(self.right);
        left.into_iter().chain(right)
    }
}

/// A line as nodes and bars in turn.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Layout {
    /// The bars from left to right.
    pub bars: Vec<ElementIndex>,
    /// The nodes from left to right.
    pub nodes: Vec<Node>,
    /// Of each bar, the node at its left and at its right; none where it is endless.
    pub ends: Vec<[Option<usize>; 2]>,
}

impl Layout {
    pub fn of(scene: &Scene) -> Layout {
        let side = |end: End| match end {
            End::Free => Some(Side::Free),
            End::Fixed => Some(Side::Fixed),
            End::Endless => None,
        };
        let mut layout = Layout { bars: Vec::new(), nodes: Vec::new(), ends: Vec::new() };
        let mut left = side(scene.line.left);
        let mut elements = Vec::new();
        for element in &scene.line.elements {
            if !matches!(scene.elements[*element].kind, Kind::Bar(_)) {
                elements.push(*element);
                continue;
            }
            let bar = layout.bars.len();
            let before = left.map(|left| layout.close(left, &mut elements, Side::Bar(bar)));
            layout.bars.push(*element);
            layout.ends.push([before, None]);
            left = Some(Side::Bar(bar));
        }
        if let (Some(left), Some(right)) = (left, side(scene.line.right)) {
            layout.close(left, &mut elements, right);
        }
        layout
    }

    /// Adds a node; a bar at its left ends there.
    fn close(&mut self, left: Side, elements: &mut Vec<ElementIndex>, right: Side) -> usize {
        let node = self.nodes.len();
        if let Side::Bar(bar) = left {
            self.ends[bar][1] = Some(node);
        }
        self.nodes.push(Node { left, elements: std::mem::take(elements), right });
        node
    }

    /// The node at which a lumped element sits.
    pub fn node_of(&self, element: ElementIndex) -> Option<usize> {
        self.nodes.iter().position(|node| node.elements.contains(&element))
    }

    /// The place of a bar in the line.
    pub fn bar(&self, element: ElementIndex) -> Option<usize> {
        self.bars.iter().position(|bar| *bar == element)
    }
}
