//! Several runs of one scene over each other.
