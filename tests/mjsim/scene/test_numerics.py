"""Scenes and numerics are checked when they are made."""

import pytest

from mjsim.scene import Numerics, Scene, resolved


@pytest.mark.parametrize("links", [5, 0, -1, 385, 24.0, "24"])
def test_a_chain_has_6_to_384_links(links):
    with pytest.raises(ValueError, match="links must be a whole number from 6 to 384"):
        resolved(Scene(), Numerics(links=links))
