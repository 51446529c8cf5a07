//! The quantities of a contact, by name.

/// Name of a quantity of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Name {
    /// Friction coefficient.
    Friction,
    /// Normal force.
    Force,
    /// Indentation depth.
    Depth,
    /// Contact area.
    Area,
    /// Largest pressure.
    Peak,
}

impl Name {
    /// All names, in the order of their indices.
    pub(crate) const IN_ORDER: [Self; 5] = [
        Self::Friction,
        Self::Force,
        Self::Depth,
        Self::Area,
        Self::Peak,
    ];

    /// Index in a vector with one entry for each name, in the order of [`IN_ORDER`](Self::IN_ORDER).
    pub(crate) const fn index(self) -> usize {
        self as usize
    }

    /// The description of the quantity with this index; for a history the quantities of all rows follow each other.
    pub(crate) fn of_quantity(index: usize) -> &'static str {
        Self::IN_ORDER[index % Self::IN_ORDER.len()].description()
    }

    /// Words for the quantity in error messages, with its unit.
    const fn description(self) -> &'static str {
        match self {
            Self::Friction => "friction coefficient",
            Self::Force => "normal force [N]",
            Self::Depth => "indentation depth [m]",
            Self::Area => "contact area [m²]",
            Self::Peak => "largest pressure [Pa]",
        }
    }
}

/// One value for each quantity of a contact, such as its result or its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Quantities<T> {
    /// Friction coefficient.
    pub(crate) friction_coefficient: T,
    /// Normal force, \[N].
    pub(crate) normal_force: T,
    /// Indentation depth, \[m].
    pub(crate) indentation_depth: T,
    /// Contact area, \[m²].
    pub(crate) contact_area: T,
    /// Largest pressure, \[Pa].
    pub(crate) peak_pressure: T,
}

impl<T: Copy> Quantities<T> {
    /// The value of one quantity.
    pub(crate) const fn get(&self, name: Name) -> T {
        match name {
            Name::Friction => self.friction_coefficient,
            Name::Force => self.normal_force,
            Name::Depth => self.indentation_depth,
            Name::Area => self.contact_area,
            Name::Peak => self.peak_pressure,
        }
    }

    /// Applies a function of name and value to each quantity.
    pub(crate) fn map<U>(&self, mut function: impl FnMut(Name, T) -> U) -> Quantities<U> {
        let mut one = |name| function(name, self.get(name));
        Quantities {
            friction_coefficient: one(Name::Friction),
            normal_force: one(Name::Force),
            indentation_depth: one(Name::Depth),
            contact_area: one(Name::Area),
            peak_pressure: one(Name::Peak),
        }
    }

    /// Names and values in the order of [`Name::IN_ORDER`].
    pub(crate) fn iter(&self) -> impl Iterator<Item = (Name, T)> {
        Name::IN_ORDER
            .into_iter()
            .map(|name| (name, self.get(name)))
    }
}
