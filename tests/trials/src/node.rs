//! What moves between two bars, as a linear system in doubles: points in a row, joined by springs and contacts.

use crate::scene::{Element, End, Load, Scene};

/// A place with one velocity.
#[derive(Default)]
pub struct Point {
    /// Whether it stands still, or moves as a load says.
    pub is_wall: bool,
    pub mass: f64,
    pub momentum: f64,
    pub loads: Vec<Load>,
    /// Stiffness and damping to the ground.
    supports: Vec<[f64; 2]>,
}

/// What joins two neighbouring points.
pub enum Link {
    Spring { stiffness: f64, damping: f64 },
    Contact(usize),
}

/// Points and links between two bars.
#[derive(Default)]
pub struct Node {
    pub points: Vec<Point>,
    pub links: Vec<Link>,
    /// The bars at the left and the right, by their number in the line.
    pub bars: [Option<usize>; 2],
    impedances: [f64; 2],
}

/// The state of a node is the velocities of its points, then a compression or gap for each link, then what each
/// support is displaced. Inputs are the two waves that arrive, then the load on each point, or its velocity where that is
/// imposed. Outputs are the velocities of the points, then the forces in the links.
pub struct Law {
    pub states: usize,
    /// How state and inputs, side by side, change the state, and what they give.
    pub change: Vec<Vec<f64>>,
    pub output: Vec<Vec<f64>>,
}

/// Which element of the line is seen where.
#[derive(Clone, Copy)]
pub enum Place {
    Point {
        node: usize,
        point: usize,
    },
    Link {
        node: usize,
        link: usize,
    },
    /// The node at the left of a bar, and that at its right.
    Bar([Option<usize>; 2]),
}

/// The nodes of a scene, and where its elements are in them.
pub fn nodes(scene: &Scene) -> (Vec<Node>, Vec<Place>) {
    let mut nodes: Vec<Node> = Vec::new();
    let mut places = Vec::new();
    let mut node = Node { points: vec![Point::default()], ..Node::default() };
    node.points[0].is_wall = scene.ends[0] == End::Fixed;
    let mut contacts = 0..;
    let mut join = |node: &mut Node, is_contact: bool| {
        if is_contact {
            node.links.push(Link::Contact(contacts.next().unwrap()));
            node.points.push(Point::default());
        }
    };
    for (number, (element, is_contact)) in scene.elements.iter().zip(&scene.joints).enumerate() {
        join(&mut node, *is_contact && scene.opens);
        let last = node.points.len() - 1;
        let point = &mut node.points[last];
        let here = Place::Point { node: nodes.len(), point: last };
        match element {
            Element::Mass { mass, velocity } => {
                point.mass += mass.value();
                point.momentum += mass.value() * velocity.value();
            }
            Element::Load(load) => {
                point.is_wall |= load.is_imposed;
                point.loads.push(load.clone());
            }
            Element::Support { stiffness, damping } => {
                point.supports.push([stiffness.value(), damping.value()]);
            }
            Element::Spring { stiffness, damping } => {
                places.push(Place::Link { node: nodes.len(), link: node.links.len() });
                let (stiffness, damping) = (stiffness.value(), damping.value());
                node.links.push(Link::Spring { stiffness, damping });
                node.points.push(Point::default());
                continue;
            }
            Element::Bar { impedance, .. } => {
                let is_beyond = number == 0 && scene.ends[0] == End::Endless;
                let left = (!is_beyond).then_some(nodes.len());
                if !is_beyond {
                    (node.bars[1], node.impedances[1]) = (Some(number), impedance.value());
                    nodes.push(std::mem::take(&mut node));
                }
                let is_last = number + 1 == scene.elements.len();
                let right = (!is_last || scene.ends[1] != End::Endless).then_some(nodes.len());
                places.push(Place::Bar([left, right]));
                node = Node { points: vec![Point::default()], ..Node::default() };
                (node.bars[0], node.impedances[0]) = (Some(number), impedance.value());
                continue;
            }
        }
        places.push(here);
    }
    join(&mut node, *scene.joints.last().unwrap() && scene.opens);
    if scene.ends[1] != End::Endless {
        node.points.last_mut().unwrap().is_wall |= scene.ends[1] == End::Fixed;
        nodes.push(node);
    }
    (nodes, places)
}

/// The solution of a small system; none where it has none.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let size = right.len();
    for i in 0..size {
        let pivot = (i..size).max_by(|a, b| matrix[*a][i].abs().total_cmp(&matrix[*b][i].abs()))?;
        matrix.swap(i, pivot);
        right.swap(i, pivot);
        if matrix[i][i].abs() < 1e-12 {
            return None;
        }
        for row in (0..size).filter(|row| *row != i) {
            let factor = matrix[row][i] / matrix[i][i];
            (0..size).for_each(|k| matrix[row][k] -= factor * matrix[i][k]);
            right[row] -= factor * right[i];
        }
    }
    Some((0..size).map(|i| right[i] / matrix[i][i]).collect())
}

impl Point {
    /// Whether its velocity is what a load says.
    fn is_imposed(&self) -> bool {
        self.loads.iter().any(|load| load.is_imposed)
    }

    /// The force of all loads, or the velocity that one of them imposes.
    pub fn given(&self, time: f64) -> f64 {
        let acts = |load: &&Load| load.is_imposed == self.is_imposed();
        self.loads.iter().filter(acts).map(|load| load.value(time)).sum()
    }
}

impl Node {
    /// The force on each point of its loads.
    fn pushed<'a>(&'a self, input: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let points = self.points.iter().zip(&input[2..]);
        points.map(|(point, load)| if point.is_imposed() { 0.0 } else { *load })
    }

    /// The contacts of this node, by their number in the line, with their links.
    pub fn contacts(&self) -> impl Iterator<Item = (usize, usize)> {
        self.links.iter().enumerate().filter_map(|(link, own)| match own {
            Link::Contact(contact) => Some((*contact, link)),
            Link::Spring { .. } => None,
        })
    }

    pub fn states(&self) -> usize {
        let supports = self.points.iter().map(|point| point.supports.len());
        self.points.len() + self.links.len() + supports.sum::<usize>()
    }

    fn supports(&self) -> impl Iterator<Item = (usize, [f64; 2])> {
        let points = self.points.iter().enumerate();
        points.flat_map(|(at, point)| point.supports.iter().map(move |own| (at, *own)))
    }

    /// The force on each point of bars, springs, supports and loads; with `rates`, how fast the part of it grows
    /// that is the stiffness of springs and supports.
    fn forces(&self, speeds: &[f64], state: &[f64], input: &[f64], rates: bool) -> Vec<f64> {
        let points = self.points.len();
        let mut forces = vec![0.0; points];
        if !rates {
            for (side, point) in [(0, 0), (1, points - 1)] {
                forces[point] += self.impedances[side] * (2.0 * input[side] - speeds[point]);
            }
            forces.iter_mut().zip(self.pushed(input)).for_each(|(force, load)| *force += load);
        }
        let resistance = |[stiffness, damping]: [f64; 2], moved: f64, speed: f64| match rates {
            true => stiffness * speed,
            false => stiffness * moved + damping * speed,
        };
        for (link, own) in self.links.iter().enumerate() {
            if let Link::Spring { stiffness, damping } = own {
                let speed = speeds[link] - speeds[link + 1];
                let force = resistance([*stiffness, *damping], state[points + link], speed);
                forces[link] -= force;
                forces[link + 1] += force;
            }
        }
        for (own, (point, law)) in self.supports().enumerate() {
            let moved = state[points + self.links.len() + own];
            forces[point] -= resistance(law, moved, speeds[point]);
        }
        forces
    }

    /// The force from outside, of loads, supports and what is fixed, and the power of loads less that of dampers.
    pub fn flow(&self, closed: &[bool], speeds: &[f64], state: &[f64], input: &[f64]) -> [f64; 2] {
        let groups = self.groups(closed);
        let is_held = |point: usize| {
            (self.points.iter().zip(&groups))
                .any(|(own, group)| own.is_wall && *group == groups[point])
        };
        let forces = self.forces(speeds, state, input, false);
        let (mut push, mut power) = (0.0, 0.0);
        for ((point, speed), load) in speeds.iter().enumerate().zip(self.pushed(input)) {
            // What holds a point, or moves it, takes all force upon it.
            let own = load - if is_held(point) { forces[point] } else { 0.0 };
            push += own;
            power += own * speed;
        }
        for (own, (point, [stiffness, damping])) in self.supports().enumerate() {
            let moved = state[self.points.len() + self.links.len() + own];
            push -= stiffness * moved + damping * speeds[point];
            power -= damping * speeds[point].powi(2);
        }
        for (link, own) in self.links.iter().enumerate() {
            if let Link::Spring { damping, .. } = own {
                power -= damping * (speeds[link] - speeds[link + 1]).powi(2);
            }
        }
        [push, power]
    }

    /// The first and last point of each group that nothing but undamped supports holds, with their force on it.
    pub fn pushes_alone(&self, closed: &[bool], state: &[f64]) -> Vec<([usize; 2], f64)> {
        let (groups, last) = (self.groups(closed), self.points.len() - 1);
        let mut alone = Vec::new();
        for group in 0..=groups[last] {
            let points = (0..=last).filter(|point| groups[*point] == group);
            let points: Vec<usize> = points.collect();
            let ends = [points[0], points[points.len() - 1]];
            let is_bare = |point: &usize| {
                let own = &self.points[*point];
                let damped = own.supports.iter().any(|[_, damping]| *damping != 0.0);
                !own.is_wall && own.mass == 0.0 && own.loads.is_empty() && !damped
            };
            let is_barred =
                ends[0] == 0 && self.bars[0].is_some() || ends[1] == last && self.bars[1].is_some();
            let is_spring = |link: usize| matches!(self.links.get(link), Some(Link::Spring { .. }));
            let is_sprung = is_spring(ends[1]) || ends[0].checked_sub(1).is_some_and(is_spring);
            if !points.iter().all(is_bare) || is_barred || is_sprung {
                continue;
            }
            let supports = self.supports().zip(&state[self.points.len() + self.links.len()..]);
            let own = supports.filter(|((point, _), _)| points.contains(point));
            alone.push((ends, own.map(|((_, [stiffness, _]), moved)| -stiffness * moved).sum()));
        }
        alone
    }

    /// The points that move together where these contacts are closed.
    pub fn groups(&self, closed: &[bool]) -> Vec<usize> {
        let mut groups = vec![0];
        for link in &self.links {
            let is_apart = !matches!(link, Link::Contact(own) if closed[*own]);
            groups.push(groups.last().unwrap() + usize::from(is_apart));
        }
        groups
    }

    /// The velocities of all points, where those of points with mass are known.
    fn speeds(&self, groups: &[usize], state: &[f64], input: &[f64]) -> Option<Vec<f64>> {
        let count = groups.last().unwrap() + 1;
        let sum = |values: &[f64], group: usize| -> f64 {
            values.iter().zip(groups).filter(|(_, own)| **own == group).map(|(v, _)| v).sum()
        };
        let has = |group: usize, is: &dyn Fn(&Point) -> bool| {
            self.points.iter().zip(groups).any(|(point, own)| *own == group && is(point))
        };
        let is_light = |group: &usize| !has(*group, &|point| point.is_wall || point.mass > 0.0);
        let light: Vec<usize> = (0..count).filter(is_light).collect();
        let spread = |values: &dyn Fn(usize) -> f64| -> Vec<f64> {
            groups.iter().map(|group| values(*group)).collect()
        };
        let first = |group: usize, is: &dyn Fn(&Point) -> bool| {
            let mut points = self.points.iter().zip(groups);
            points.position(|(point, own)| *own == group && is(point))
        };
        let known = |group: usize| match first(group, &Point::is_imposed) {
            Some(point) => input[2 + point],
            None if light.contains(&group) || has(group, &|p| p.is_wall) => 0.0,
            None => state[first(group, &|point| point.mass > 0.0).unwrap()],
        };
        let known = spread(&known);
        let none = (vec![0.0; state.len()], vec![0.0; input.len()]);
        let row = |group: usize, rates: bool| -> Vec<f64> {
            let by = |moving: &usize| {
                let speeds = spread(&|own| f64::from(own == *moving));
                -sum(&self.forces(&speeds, &none.0, &none.1, rates), group)
            };
            light.iter().map(by).collect()
        };
        let (mut matrix, mut right) = (Vec::new(), Vec::new());
        for group in &light {
            // Where nothing resists a velocity the balance is one of springs, and so is its derivative; the derivatives of
            // loads are not worked out here.
            let damped = row(*group, false);
            let rates = damped.iter().all(|entry| *entry == 0.0);
            if rates && has(*group, &|point| !point.loads.is_empty()) {
                return None;
            }
            matrix.push(if rates { row(*group, true) } else { damped });
            right.push(sum(&self.forces(&known, state, input, rates), *group));
        }
        let found = solve(matrix, right)?;
        let mut speeds = known;
        for (speed, group) in speeds.iter_mut().zip(groups) {
            if let Some(place) = light.iter().position(|own| own == group) {
                *speed = found[place];
            }
        }
        Some(speeds)
    }

    /// How the state changes, and the outputs.
    fn motion(&self, closed: &[bool], state: &[f64], input: &[f64]) -> Option<[Vec<f64>; 2]> {
        let (points, groups) = (self.points.len(), self.groups(closed));
        let speeds = self.speeds(&groups, state, input)?;
        let forces = self.forces(&speeds, state, input, false);
        let mut change = vec![0.0; points];
        let mut inner = vec![0.0; self.links.len()];
        for group in 0..=*groups.last().unwrap() {
            let own: Vec<usize> = (0..points).filter(|point| groups[*point] == group).collect();
            let mass: f64 = own.iter().map(|point| self.points[*point].mass).sum();
            let is_held = own.iter().any(|point| self.points[*point].is_wall);
            let total: f64 = own.iter().map(|point| forces[*point]).sum();
            let acceleration = if mass > 0.0 && !is_held { total / mass } else { 0.0 };
            own.iter().for_each(|point| change[*point] = acceleration);
            let surplus = |point: usize| forces[point] - self.points[point].mass * acceleration;
            let (first, last) = (own[0], own[own.len() - 1]);
            // What is pushed from the left, or held at the left, goes on to the right.
            for (link, force) in inner.iter_mut().enumerate().take(last).skip(first) {
                *force = match (first..=link).any(|point| self.points[point].is_wall) {
                    false => (first..=link).map(surplus).sum(),
                    true => -(link + 1..=last).map(surplus).sum::<f64>(),
                };
            }
        }
        for (link, own) in self.links.iter().enumerate() {
            let approach = speeds[link] - speeds[link + 1];
            match own {
                Link::Spring { stiffness, damping } => {
                    inner[link] = stiffness * state[points + link] + damping * approach;
                    change.push(approach);
                }
                Link::Contact(_) => change.push(-approach),
            }
        }
        change.extend(self.supports().map(|(point, _)| speeds[point]));
        Some([change, [speeds, inner].concat()])
    }

    /// The law with these contacts closed; none where something without mass meets no resistance.
    pub fn law(&self, closed: &[bool]) -> Option<Law> {
        let (states, inputs) = (self.states(), 2 + self.points.len());
        let mut change = vec![Vec::new(); states];
        let mut output = vec![Vec::new(); self.points.len() + self.links.len()];
        for column in 0..states + inputs {
            let unit: Vec<f64> = (0..states + inputs).map(|k| f64::from(k == column)).collect();
            let told = self.motion(closed, &unit[..states], &unit[states..])?;
            for (rows, told) in [&mut change, &mut output].into_iter().zip(told) {
                rows.iter_mut().zip(told).for_each(|(row, value)| row.push(value));
            }
        }
        Some(Law { states, change, output })
    }
}

impl Law {
    /// About how fast the state changes: a norm of a power of the matrix.
    pub fn rate(&self) -> f64 {
        let product = |a: &Vec<Vec<f64>>| -> Vec<Vec<f64>> {
            let entry = |i: usize, j: usize| (0..self.states).map(|k| a[i][k] * a[k][j]).sum();
            (0..self.states).map(|i| (0..self.states).map(|j| entry(i, j)).collect()).collect()
        };
        let one = self.change.iter().map(|row| row[..self.states].to_vec()).collect();
        let eighth = product(&product(&product(&one)));
        let norm = eighth.iter().map(|row| row.iter().map(|a| a.abs()).sum::<f64>());
        norm.fold(0.0, f64::max).powf(0.125)
    }
}
