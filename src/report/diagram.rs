//! The object graph as it is drawn: boxes, edges, and where they stand.

use super::order::drivers_first;
use crate::dynamics::model::{
    Closure, Coordinate, LinkageBody, Model, MultiLinkageBody, NodeMotion, OUTPUT, ObjectPart,
    Pair, PartInput, STOP,
};
use crate::report::show::{equations, motion, position};

/// The object graph of a model, for pictures and texts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diagram {
    /// The objects, drivers before what they drive.
    pub boxes: Vec<ObjectBox>,
}

/// Box of the diagram: an object of the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectBox {
    /// Id in the scene.
    pub id: String,
    /// Kind in the scene.
    pub kind: String,
    /// `rigid`, `2 masses`, `modes`, `62.83 rad/s`, `motor`.
    pub detail: String,
    /// Inputs with what drives them, in their order; empty for a drive.
    pub inputs: Vec<BoxInput>,
    /// Short text of the position function: `U = (π/2)·sin φ`, `cam, lift 8 mm`.
    pub position: String,
    /// Closure of the driving pair: how it is kept together.
    pub closure: Closure,
    /// Gap of a form-closed pair.
    pub gap: f64,
    /// Turning or sliding.
    pub coordinate: Coordinate,
}

/// An input of a box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoxInput {
    /// Place of the driving object in [`Diagram::boxes`].
    pub driver: usize,
    /// Name of the connection: of an object with several inputs the port; empty
    /// otherwise.
    pub name: String,
}

impl ObjectBox {
    /// True of a drive: nothing drives it.
    pub fn is_drive(&self) -> bool {
        self.inputs.is_empty()
    }
}

/// Place of a box on the grid: columns follow the flow of motion, rows spread the
/// followers; both in units of one box, rows may be halves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Distance from the drive.
    pub column: usize,
    /// Row, 0 at the top.
    pub row: f64,
}

impl Diagram {
    /// The graph of a model.
    pub fn of(model: &Model) -> Self {
        let order = drivers_first(model);
        let place = |object: usize| order.iter().position(|&other| other == object);
        let boxes = order
            .iter()
            .map(|&index| {
                let object = &model.objects[index];
                let pair = pair(model, object);
                ObjectBox {
                    id: object.id.clone(),
                    kind: object.kind.to_owned(),
                    detail: match model.stop(index) {
                        Some(stop) => equations::stop_words(&stop, object.coordinate),
                        None => detail(model, object),
                    },
                    inputs: inputs(object, place),
                    position: law_text(model, index),
                    closure: pair.map_or(Closure::Bilateral, |pair| pair.closure),
                    gap: pair.map_or(0.0, |pair| pair.gap),
                    coordinate: object.coordinate,
                }
            })
            .collect();
        Self { boxes }
    }

    /// Followers of a box, in their order; what has several inputs follows the first.
    pub fn followers(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let first = |other: usize| self.boxes[other].inputs.first();
        let drives = move |other: &usize| first(*other).is_some_and(|one| one.driver == index);
        (0..self.boxes.len()).filter(drives)
    }

    /// Places of all boxes: a tidy tree, every driver level with the middle of
    /// its followers, no two boxes on one place.
    pub fn places(&self) -> Vec<Place> {
        let origin = Place {
            column: 0,
            row: 0.0,
        };
        let mut places = vec![origin; self.boxes.len()];
        // Drivers stand before what they drive: forwards for the columns …
        for index in 0..self.boxes.len() {
            for input in &self.boxes[index].inputs {
                let behind = places[input.driver].column + 1;
                places[index].column = places[index].column.max(behind);
            }
        }
        let mut next_row = 0.0;
        for (index, one) in self.boxes.iter().enumerate() {
            if one.is_drive() {
                self.assign_leaf_rows(index, &mut places, &mut next_row);
            }
        }
        // … and backwards for the rows of those that have followers.
        for index in (0..self.boxes.len()).rev() {
            let rows: Vec<f64> = self.followers(index).map(|f| places[f].row).collect();
            if let (Some(first), Some(last)) = (rows.first(), rows.last()) {
                places[index].row = (first + last) / 2.0;
            }
        }
        places
    }

    /// Gives the leaves under `root` successive rows, in depth-first order.
    fn assign_leaf_rows(&self, root: usize, places: &mut [Place], next_row: &mut f64) {
        let mut stack = vec![root];
        while let Some(index) = stack.pop() {
            let mut followers: Vec<usize> = self.followers(index).collect();
            if followers.is_empty() {
                places[index].row = *next_row;
                *next_row += 1.0;
            }
            followers.reverse();
            stack.extend(followers);
        }
    }
}

/// The inputs of an object, given the place of each object among the boxes.
fn inputs(object: &ObjectPart, place: impl Fn(usize) -> Option<usize>) -> Vec<BoxInput> {
    let several = object.inputs.len() > 1;
    let input = |input: &PartInput| {
        let name = if several {
            input.port.clone()
        } else {
            String::new()
        };
        let driver = place(input.driver)?;
        Some(BoxInput { driver, name })
    };
    object.inputs.iter().filter_map(input).collect()
}

/// The driving pair of an object; `None` for a drive or a bilateral rigid object.
pub fn pair<'a>(model: &'a Model, object: &'a ObjectPart) -> Option<&'a Pair> {
    match model.pair_link(object).map(|link| &model.links[link].base) {
        Some(crate::dynamics::model::LinkBase::Law { pair }) => Some(pair),
        _ => object.rigid_pair.as_ref(),
    }
}

/// Detail that the box shows below the kind.
fn detail(model: &Model, object: &ObjectPart) -> String {
    let motion = object.nodes.first().map(|&node| &model.nodes[node].motion);
    match motion {
        Some(NodeMotion::Prescribed { motion, .. }) => motion::summary(motion, object.coordinate),
        Some(NodeMotion::Rotor { .. }) if object.kind == OUTPUT => "free".into(),
        Some(NodeMotion::Rotor { .. }) => "motor".into(),
        Some(NodeMotion::Constrained { .. }) => multi_input_block(model, object),
        Some(NodeMotion::Rigid { .. }) => rigid(model, object),
        _ => match object.nodes.len() {
            1 => "1 mass".into(),
            _ if is_of_modes(model, object) => "modes".into(),
            count => format!("{count} masses"),
        },
    }
}

/// True of a chain that modes behind a contact are.
fn is_of_modes(model: &Model, object: &ObjectPart) -> bool {
    (model.reduced.iter()).any(|reduced| model.objects[reduced.object].id == object.id)
}

/// A linkage of several inputs, or an output of it.
fn multi_input_block(model: &Model, object: &ObjectPart) -> String {
    let is = |body: &&MultiLinkageBody| object.nodes.first() == Some(&body.node);
    match model.multi_linkages.iter().find(is) {
        Some(body) => format!("{} links", body.linkage.spec().linkage.links.len()),
        None => "rigid".into(),
    }
}

fn rigid(model: &Model, object: &ObjectPart) -> String {
    let is = |body: &&LinkageBody| object.nodes.first() == Some(&body.node);
    match model.linkages.iter().find(is) {
        Some(body) => format!("{} links", body.linkage.spec().links.len()),
        None => "rigid".into(),
    }
}

/// The position function of a driven object; empty for a drive.
fn law_text(model: &Model, index: usize) -> String {
    if let Some(sum) = equations::inputs_summary(model, index) {
        return sum;
    }
    let object = &model.objects[index];
    let node = object.nodes.first();
    let law = node.and_then(|&node| model.nodes[node].motion.law());
    match law.filter(|_| object.kind != STOP) {
        Some(law) => position::summary(law, object.coordinate),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::Diagram;
    use crate::report::fixture;

    #[test]
    fn every_driver_stands_level_with_its_followers_and_no_two_share_a_place() {
        let diagram = Diagram::of(&fixture::fan_out());
        let places = diagram.places();
        let at = |id: &str| places[diagram.boxes.iter().position(|b| b.id == id).unwrap()];
        assert_eq!(diagram.boxes[0].id, "motor");
        assert_eq!((at("motor").column, at("shaft").column), (0, 1));
        assert_eq!(at("left").column, 2);
        assert_eq!(at("shaft").row, (at("left").row + at("right").row) / 2.0);
        for (index, one) in places.iter().enumerate() {
            assert!(places[..index].iter().all(|other| other != one));
        }
    }
}
