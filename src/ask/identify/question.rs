//! What is sought from records.

/// Starts if none are named.
pub const USUAL_STARTS: usize = 8;

/// Record of a motion: a table with a header, as tables beside scenes have.
#[derive(Clone, Debug, Default)]
pub struct MeasuredRecord {
    /// Name of the file, for messages.
    pub name: String,
    /// The table as CSV. Its first column is the time.
    pub text: String,
    /// Settings of the scene that hold for this record alone.
    pub settings: Vec<String>,
}

/// What is sought, and from what.
#[derive(Clone, Debug)]
pub struct IdentifyQuestion {
    /// The records.
    pub records: Vec<MeasuredRecord>,
    /// Columns and the signals that they measure: `x=rocker.delta`.
    pub signals: Vec<String>,
    /// Numbers of the scene with their ranges: `rocker.stiffness=5:20 MN m/rad`, with `:START` for
    /// the value of the first start, and `:log` for equal ratios.
    pub vary: Vec<String>,
    /// Standard deviations of columns: `x=1 µrad`.
    pub sigmas: Vec<String>,
    /// Number of starts.
    pub starts: usize,
    /// Whether rows after the first separation of a contact are left out.
    pub until_first_separation: bool,
    /// Number of threads; default: one for every processor core. Results do not depend on it.
    pub threads: Option<usize>,
}

impl Default for IdentifyQuestion {
    fn default() -> Self {
        Self {
            records: Vec::new(),
            signals: Vec::new(),
            vary: Vec::new(),
            sigmas: Vec::new(),
            starts: USUAL_STARTS,
            until_first_separation: false,
            threads: None,
        }
    }
}
