"""The paper's figures made anew, each a pure function of data that is written beside it."""
