//! Kinematics against closed forms.
