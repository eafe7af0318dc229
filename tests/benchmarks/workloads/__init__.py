"""W1 to W8 of docs/performance.md: each is a function of how often, and whether what takes minutes is run, too."""
from workloads import block, campaigns, lumped, reduced

WORKLOADS = {"W1": block.w1, "W2": block.w2, "W3": lumped.w3, "W4": reduced.w4, "W5": lumped.w5, "W6": reduced.w6,
             "W7": reduced.w7, "W8": campaigns.w8}
