//! friction-analytic
