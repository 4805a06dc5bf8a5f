#pragma once
// A function compiled once for each instruction set; the loader chooses by the machine. For functions whose loops are all that counts;
// without contraction (-ffp-contract=off) all have the same bits. Of a template, g++ 12 makes the clones only where the definition
// stands before the first use.

#define COULOIR_CLONES __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
