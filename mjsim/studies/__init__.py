"""Studies of the methods: accuracy against cost, stability, the figures of [Majidi13]."""
