//! Rigid contacts that come together or apart, and where they stand at the start.

use super::super::System;
use super::super::pairs::OPEN;
use super::super::passes::{Extent, Work};
use crate::dynamics::integrate::{EventFunction, Impact, Modes, PhysicalStop, SwitchEvent};
use crate::dynamics::model::ObjectPart;
use crate::dynamics::restitution;

/// Roundings of a displacement within which a contact touches at t = 0.
const TOUCH: f64 = 8.0 * f64::EPSILON;

impl System {
    /// True when the pair of an object, or the stop that it is, is a rigid contact.
    pub fn is_rigid_contact(&self, object: usize) -> bool {
        let component = self.pair_component(object);
        component.is_some_and(|component| self.frozen.is_rigid(component))
    }

    /// A rigid contact comes together, or apart.
    ///
    /// # Errors
    /// It is pressed together between what cannot give way.
    pub(in crate::dynamics::system) fn pass_rigid(
        &self,
        time: f64,
        y: &mut [f64],
        watch: &EventFunction,
        modes: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop> {
        let frozen = &self.frozen;
        let mut work = Work::new(frozen);
        let component = watch.component;
        if watch.target == OPEN {
            let contact = (component, modes.0[component]);
            frozen.set_on_flank(contact, 0.0, (time, &modes.0), y, &mut work);
            modes.0[component] = OPEN;
            return Ok(None);
        }
        self.collide(time, y, (component, watch.target), &mut modes.0, &mut work)
    }

    /// The impact of a contact that comes together.
    fn collide(
        &self,
        time: f64,
        y: &mut [f64],
        contact: (usize, i64),
        modes: &mut [i64],
        work: &mut Work<f64>,
    ) -> Result<Option<Impact>, PhysicalStop> {
        let frozen = &self.frozen;
        let (component, side) = contact;
        let n = frozen.coordinates;
        // What is held is where it is held, whatever an integration has made of that.
        for other in 0..frozen.contacts() {
            if frozen.contact_of(other).contact_holds(modes[other]) {
                frozen.set_on_flank((other, modes[other]), 0.0, (time, modes), y, work);
            }
        }
        frozen.motion(time, y, modes, Extent::Full, work);
        let still = vec![0.0; n];
        let approach = frozen.approach_rates(contact, y, &still, work)[0];
        if approach < 0.0 {
            // It is going apart: by no more than rounding it was behind its flank.
            frozen.set_on_flank(contact, approach, (time, modes), y, work);
            return Ok(None);
        }
        let response = frozen.complementary(time, y, modes, contact, work);
        let response = response.ok_or_else(|| self.jammed(time, component))?;
        let coefficient = frozen.contact_of(component).restitution().unwrap_or(0.0);
        let jump = |y: &mut [f64], rate: f64| {
            let impulse = (approach + rate) / -response.own;
            for (index, jump) in response.rates.iter().enumerate() {
                y[n + index] += impulse * jump;
            }
            impulse
        };
        let before = y.to_vec();
        let mut rate = coefficient * approach;
        let mut impulse = jump(y, rate);
        frozen.set_on_flank(contact, -rate, (time, modes), y, work);
        modes[component] = side;
        let pressing = -frozen.parting(component, time, y, modes, work);
        let rests = restitution::time_of_rest(
            time,
            frozen.size_of(component, y),
            [rate, pressing],
            coefficient,
        );
        if rests.is_some() {
            y.copy_from_slice(&before);
            rate = 0.0;
            impulse = jump(y, rate);
            frozen.set_on_flank(contact, 0.0, (time, modes), y, work);
        } else {
            modes[component] = OPEN;
        }
        Ok(Some(Impact {
            component,
            side,
            approach,
            impulse,
            lost: 0.5 * impulse * (approach - rate),
            drives: impulse * response.work_of_drives(),
            rests,
        }))
    }

    /// Works of the prescribed drives in the impact of a switch (J), with their objects; none where
    /// it is none.
    pub fn works_in_impact(&self, event: &SwitchEvent<'_>) -> Vec<(usize, f64)> {
        let Some((impact, before)) = event.impact else {
            return Vec::new();
        };
        let frozen = &self.frozen;
        let mut modes = event.before.0.clone();
        modes[impact.component] = OPEN;
        let contact = (impact.component, impact.side);
        let mut work = Work::new(frozen);
        let response = frozen.complementary(event.time, before, &mut modes, contact, &mut work);
        let parts = self.model.objects.iter().enumerate();
        let drives = parts.filter(|(_, part)| part.is_drive());
        let works = response.map_or(Vec::new(), |response| response.drives);
        let own = |(object, part): (usize, &ObjectPart)| {
            let node = frozen.internal[*part.nodes.last()?];
            let (_, share) = works.iter().find(|(drive, _)| *drive == node)?;
            Some((object, impact.impulse * share))
        };
        drives.filter_map(own).collect()
    }

    fn jammed(&self, time: f64, component: usize) -> PhysicalStop {
        let is = |part: &usize| self.pair_component(*part) == Some(component);
        let object = (0..self.model.objects.len()).find(is).unwrap_or(0);
        let id = &self.model.objects[object].id;
        let at = crate::units::shown(time, 9);
        PhysicalStop {
            name: "jammed",
            object: id.clone(),
            message: format!(
                "{id} is pressed together between rigid contacts at t = {at} s: nothing there is \
                 elastic, and no motion goes on"
            ),
        }
    }

    /// Sets the modes of rigid contacts that touch without a speed: held, but for those
    /// that would come apart.
    ///
    /// # Errors
    /// What stands within a rigid flank.
    pub(in crate::dynamics::system) fn settle_rigid(
        &self,
        y: &mut [f64],
        noise: &[f64],
        modes: &mut [i64],
    ) -> Result<(), Vec<crate::fault::Fault>> {
        let frozen = &self.frozen;
        let mut work = Work::new(frozen);
        let mut faults = Vec::new();
        let mut touching = Vec::new();
        for component in 0..frozen.contacts() {
            if !frozen.is_rigid(component) {
                continue;
            }
            modes[component] = OPEN;
            frozen.motion(0.0, y, modes, Extent::Full, &mut work);
            let place = frozen.place_of(component);
            let still = vec![0.0; frozen.coordinates];
            let (x, at) = match frozen.pairs.get(component) {
                Some(_) => (y[place], 0.0),
                None => {
                    let stop = &frozen.stops[component - frozen.pairs.len()];
                    let displacement = work.displacement[stop.node];
                    (
                        stop.deformation(displacement),
                        displacement.abs() + stop.at.abs(),
                    )
                }
            };
            let contact = frozen.contact_of(component);
            let doubt = TOUCH * (noise[place] + at + contact.half_gap);
            for &side in contact.sides() {
                let (depth, _) = contact.penetration(side, x, 0.0);
                if depth > doubt {
                    faults.push(self.fault_of_penetration(component, depth));
                } else if depth >= -doubt {
                    let rate = frozen.approach_rates((component, side), y, &still, &work)[0];
                    let speeds = noise[frozen.coordinates + place]
                        + work.speed[frozen.node_of(component)].abs();
                    if rate.abs() <= TOUCH * speeds {
                        frozen.set_on_flank((component, side), 0.0, (0.0, modes), y, &mut work);
                        modes[component] = side;
                        touching.push(component);
                    } else if rate > 0.0 {
                        frozen.set_on_flank((component, side), rate, (0.0, modes), y, &mut work);
                    }
                }
            }
        }
        // Each round opens one; what has opened presses on none of the others.
        for _ in 0..touching.len() {
            let parts = |&&component: &&usize| {
                modes[component] != OPEN
                    && frozen.parting(component, 0.0, y, modes, &mut work) > 0.0
            };
            match touching.iter().find(parts) {
                Some(&component) => modes[component] = OPEN,
                None => break,
            }
        }
        match faults.is_empty() {
            true => Ok(()),
            false => Err(faults),
        }
    }

    fn fault_of_penetration(&self, component: usize, depth: f64) -> crate::fault::Fault {
        let is = |part: &usize| self.pair_component(*part) == Some(component);
        let object = (0..self.model.objects.len()).find(is).unwrap_or(0);
        let id = &self.model.objects[object].id;
        let depth = crate::units::shown(depth, 6);
        crate::fault::Fault::new(
            format!("run.start.{id}"),
            format!("at t = 0 {id} is {depth} within its rigid contact"),
            "a start on the flank or clear of it, or a contact with a stiffness",
        )
    }
}
