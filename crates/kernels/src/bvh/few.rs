//! What a tree holds, where that is little: its triangles one by one, and boxes around all else.

use super::layout::{Boxes, InstanceRecord, Kind, Node, Parts4, Ref, SecondBoxes, Triangles4, Unit, around};
use super::{Accel, NONE};

/// A triangle of render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FewTriangle {
    /// Its corners, as rays are tested with them.
    pub corners: [[f32; 3]; 3],
    /// Its primitive id.
    pub primitive: u32,
}

/// What is in a tree, near things near each other.
#[derive(Clone, Debug)]
pub struct Few {
    /// Triangles that are not those of placed instances, each once.
    pub triangles: Vec<FewTriangle>,
    /// Boxes of leaves of anything else: spheres, curved shapes, instances.
    pub boxes: SecondBoxes,
}

impl Accel {
    /// All that is in the tree, where that is no more than so many triangles, and no more leaves of anything else than
    /// there are boxes. `None` too where a mesh is in the tree and placed elsewhere as well: its primitives tell no
    /// triangle then.
    pub fn few(&self, most: usize) -> Option<Few> {
        let is_placed = |record: &InstanceRecord| record.mesh & InstanceRecord::DIRECT == 0;
        let is_here = |record: &InstanceRecord| self.meshes[record.mesh as usize].direct_instance != NONE;
        if self.records().iter().any(|record| is_placed(record) && is_here(record)) {
            return None;
        }
        let mut few = Few { triangles: Vec::new(), boxes: Boxes::NONE };
        let mut walk = Walk { units: self.arena.units(), most, few: &mut few };
        walk.visit(self.root, around(&self.bounds)).then_some(few)
    }

    /// The primitives that lie in one plane with others, rising: what goes to them ends before those, and may find them
    /// covered.
    pub fn in_one_plane(&self) -> Vec<u32> {
        self.coplanar.as_ref().map(|coplanar| coplanar.primitives()).unwrap_or_default()
    }
}

struct Walk<'a> {
    units: &'a [Unit],
    most: usize,
    few: &'a mut Few,
}

impl Walk<'_> {
    /// Takes what a reference leads to, which is in a box; `false` where that is too much.
    fn visit(&mut self, reference: Ref, planes: [f32; 6]) -> bool {
        match reference.kind() {
            Kind::Nothing => true,
            Kind::Node(unit) => {
                let node: Node = self.read(unit);
                node.boxes().all(|(planes, child)| self.visit(child, planes))
            }
            Kind::Triangles(unit) => self.leaf(&self.read(unit)),
            Kind::Parts(unit) => self.leaf(&self.read::<Parts4>(unit).triangles),
            Kind::Spheres(_) | Kind::Instance(_) => {
                let fits = self.few.boxes.len < self.few.boxes.planes[0].len();
                if fits {
                    self.few.boxes.push(planes);
                }
                fits
            }
        }
    }

    fn leaf(&mut self, leaf: &Triangles4) -> bool {
        for place in (0..4).filter(|&place| leaf.ids[place] != NONE) {
            let corners = leaf.vertices.map(|vertex| vertex.map(|axis| axis[place]));
            let triangle = FewTriangle { corners, primitive: leaf.ids[place] };
            // The parts of one that was cut.
            if !self.few.triangles.contains(&triangle) {
                self.few.triangles.push(triangle);
            }
        }
        self.few.triangles.len() <= self.most
    }

    fn read<T: bytemuck::Pod>(&self, unit: usize) -> T {
        bytemuck::cast_slice::<Unit, T>(&self.units[unit..unit + size_of::<T>() / size_of::<Unit>()])[0]
    }
}
