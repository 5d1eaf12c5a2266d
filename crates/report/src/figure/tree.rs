//! Drawings of the decomposition trees of moves.

use mediant_moves::{DecompositionTree, Vector};

use super::{
    canvas::{Anchor, Canvas, MARGIN, WIDTH},
    geometry::{Point, Rect},
    text::{LINE, TEXT, text_width, wrap},
};

const NODE_HEIGHT: f64 = 22.0;
const LEVEL: f64 = 50.0;
const BETWEEN_NODES: f64 = 8.0;
const BETWEEN_TREES: f64 = 36.0;

/// A drawing of decomposition trees side by side, as in Kramm et al. 2018, Figure 5. Nodes are moves, with
/// their children below them; leaves are filled. A tree that does not fit into a row begins the next one.
#[derive(Clone, Debug)]
pub struct TreeDrawing {
    title: String,
    note: Option<String>,
    trees: Vec<Tree>,
}

impl TreeDrawing {
    /// A drawing without trees.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), note: None, trees: Vec::new() }
    }

    /// The same drawing with a line under the title.
    #[must_use]
    pub fn note(self, note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..self }
    }

    /// The same drawing with one more tree, and a caption above it.
    #[must_use]
    pub fn tree(mut self, caption: impl Into<String>, tree: &DecompositionTree) -> Self {
        self.trees.push(Tree::new(&caption.into(), tree));
        self
    }

    /// The drawing as a whole SVG file.
    #[must_use]
    pub fn svg(&self) -> String {
        let widest = self.trees.iter().map(|tree| tree.width).fold(0.0, f64::max);
        // If a tree is wider than the page, the whole figure is scaled down.
        let page = WIDTH.max(widest + 2.0 * MARGIN);
        let mut canvas = Canvas::default();
        let mut y = canvas.header(&self.title, self.note.as_deref(), page) + 6.0;
        for row in self.rows(page - 2.0 * MARGIN) {
            let width: f64 = row.iter().map(|tree| tree.width).sum::<f64>();
            let spare = page - 2.0 * MARGIN - width;
            // The trees share the spare room as gaps, up to a limit; the row is centered.
            let gap = (spare / row.len() as f64).clamp(0.0, 2.5 * BETWEEN_TREES);
            let mut x = MARGIN + (spare - gap * (row.len() - 1) as f64) / 2.0;
            let captions = row.iter().map(|tree| tree.caption.len()).max().unwrap_or(0) as f64 * LINE;
            for tree in row {
                tree.draw(&mut canvas, (x, y), captions);
                x += tree.width + gap;
            }
            y += captions + row.iter().map(|tree| tree.height).fold(0.0, f64::max) + 24.0;
        }
        canvas.finish(&self.title, &self.description(), page, y)
    }

    fn rows(&self, room: f64) -> Vec<&[Tree]> {
        let mut rows = Vec::new();
        let (mut first, mut width) = (0, 0.0);
        for (i, tree) in self.trees.iter().enumerate() {
            if i > first && width + BETWEEN_TREES + tree.width > room {
                rows.push(&self.trees[first..i]);
                (first, width) = (i, 0.0);
            }
            width += tree.width + if i > first { BETWEEN_TREES } else { 0.0 };
        }
        if first < self.trees.len() {
            rows.push(&self.trees[first..]);
        }
        rows
    }

    fn description(&self) -> String {
        let trees = self.trees.iter().map(|tree| {
            let leaves: Vec<&str> = tree.leaves.iter().map(|&leaf| &*tree.nodes[leaf].label).collect();
            format!("{}: leaves {}", tree.caption.join(" "), leaves.join(" "))
        });
        let note = self.note.as_deref().map_or(String::new(), |note| format!(" {note}"));
        format!("Decomposition trees. {}.{note}", trees.collect::<Vec<_>>().join("; "))
    }
}

#[derive(Clone, Debug)]
struct Node {
    label: String,
    center: Point,
    children: Option<[usize; 2]>,
}

/// A tree with its layout. Its origin (0, 0) is the middle of the upper border.
#[derive(Clone, Debug)]
struct Tree {
    caption: Vec<String>,
    nodes: Vec<Node>,
    leaves: Vec<usize>,
    width: f64,
    height: f64,
    node_width: f64,
}

impl Tree {
    /// Computes the layout: leaves are side by side, each at its own depth, and a parent is above the middle
    /// of its children.
    fn new(caption: &str, tree: &DecompositionTree) -> Self {
        let mut nodes: Vec<Node> = tree
            .nodes()
            .iter()
            .map(|node| {
                let children = node.children.map(|(left, right)| [left as usize, right as usize]);
                Node { label: label(node.label), center: (0.0, NODE_HEIGHT / 2.0), children }
            })
            .collect();
        let widest = nodes.iter().map(|node| text_width(&node.label, TEXT)).fold(0.0, f64::max);
        let (node_width, step) = (widest + 12.0, widest + 12.0 + BETWEEN_NODES);
        let mut leaves = Vec::new();
        let mut stack = vec![0];
        while let Some(at) = stack.pop() {
            let (_, y) = nodes[at].center;
            match nodes[at].children {
                None => {
                    nodes[at].center.0 = leaves.len() as f64 * step;
                    leaves.push(at);
                }
                Some([left, right]) => {
                    nodes[left].center.1 = y + LEVEL;
                    nodes[right].center.1 = y + LEVEL;
                    stack.extend([right, left]);
                }
            }
        }
        // Nodes are in breadth-first order, so children come after their parents.
        for at in (0..nodes.len()).rev() {
            if let Some([left, right]) = nodes[at].children {
                nodes[at].center.0 = (nodes[left].center.0 + nodes[right].center.0) / 2.0;
            }
        }
        let deepest = nodes.iter().map(|node| node.center.1).fold(0.0, f64::max);
        let caption = wrap(caption, TEXT, 240.0);
        let captions = caption.iter().map(|line| text_width(line, TEXT) + 8.0).fold(0.0, f64::max);
        let spread = leaves.len().saturating_sub(1) as f64 * step;
        for node in &mut nodes {
            node.center.0 -= spread / 2.0;
        }
        let width = (spread + node_width).max(captions);
        Self { caption, nodes, leaves, width, height: deepest + NODE_HEIGHT / 2.0, node_width }
    }

    fn draw(&self, canvas: &mut Canvas, (x, y): Point, captions: f64) {
        let middle = x + self.width / 2.0;
        for (line, i) in self.caption.iter().zip(0_u32..) {
            canvas.text("strong", Anchor::Middle, (middle, y + f64::from(i) * LINE + 8.0), line);
        }
        let at = |node: &Node| (middle + node.center.0, y + captions + 4.0 + node.center.1);
        for node in &self.nodes {
            for child in node.children.into_iter().flatten() {
                let (from, to) = (at(node), at(&self.nodes[child]));
                let half = NODE_HEIGHT / 2.0;
                canvas.line("edge", (from.0, from.1 + half), (to.0, to.1 - half));
            }
        }
        for node in &self.nodes {
            let (x, y) = at(node);
            let half = self.node_width / 2.0;
            let class = if node.children.is_none() { "leaf" } else { "node" };
            canvas.rect(class, Rect::new(x - half, y - NODE_HEIGHT / 2.0, 2.0 * half, NODE_HEIGHT), 6.0);
            canvas.text("", Anchor::Middle, (x, y + 4.0), &node.label);
        }
    }
}

fn label(v: Vector) -> String {
    format!("({}, {})", v.x, v.y).replace('-', "−")
}
