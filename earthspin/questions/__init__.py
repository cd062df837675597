"""One module for each computation that users can request, and modules with shared code.

Parts, the functions that answer a question, convert between labelled data and the arrays of the
physics packages. Modules that load large libraries are imported when they are first used, so that a
question loads only what it needs.
"""

#: Every question by its public call, in the order in which they are listed, and the module of each.
MODULES = {
    "precession": "earthspin.questions.precession",
    "torque_series": "earthspin.questions.torque",
    "pole": "earthspin.questions.pole",
    "compare_iau": "earthspin.questions.iau",
    "nutation_ladder": "earthspin.questions.nutation",
    "long_term": "earthspin.questions.long_term",
    "insolation": "earthspin.questions.insolation",
    "rotation": "earthspin.questions.rotation",
    "wobble_ladder": "earthspin.questions.wobble",
    "polar_motion": "earthspin.questions.polar_motion",
    "pole_offsets": "earthspin.questions.pole_offsets",
    "length_of_day": "earthspin.questions.length_of_day",
    "observed_day": "earthspin.questions.observed_day",
    "forecast": "earthspin.questions.forecast",
    "free_rotor": "earthspin.questions.free_rotor",
    "heavy_top": "earthspin.questions.top",
    "spheroid_field": "earthspin.questions.spheroid",
    "cassini_states": "earthspin.questions.cassini_states",
    "love_numbers": "earthspin.questions.love_numbers",
}
