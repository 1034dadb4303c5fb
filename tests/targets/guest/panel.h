/* SPDX-License-Identifier: MIT
 *
 * panel - the bank of most tests: four inputs and four outputs, for programs/panel.rung.
 */
#ifndef GUEST_PANEL_H
#define GUEST_PANEL_H

#include "tests/targets/guest/bank.h"
#include "tests/targets/guest/child.h"

#define IN0  0 /* lines of the bank                                         */
#define OUT0 4
#define OUTS 4

extern struct bank panel;

/* A map of the panel: options of the inputs, then of each output. */
#define PANEL_MAP(in, out0, out1, out2, out3)                                 \
	"BOARD \"panel\"\n"                                                   \
	"%IX0.0 gpio line=IN0 " in "\n%IX0.1 gpio line=IN1 " in "\n"          \
	"%IX0.2 gpio line=IN2 " in "\n%IX0.3 gpio line=IN3 " in "\n"          \
	"%QX0.0 gpio line=OUT0 " out0 "\n%QX0.1 gpio line=OUT1 " out1 "\n"    \
	"%QX0.2 gpio line=OUT2 " out2 "\n%QX0.3 gpio line=OUT3 " out3 "\n"
/* Levels of the outputs in RUN, with I0, and safe, with this map. */
#define PANEL_RUNS    0x5u
#define PANEL_IS_SAFE 0xau
#define PANEL_SAFE PANEL_MAP("", "safe=0", "safe=1", "active-low safe=1", "active-low safe=0")
/* A map whose outputs are off as long as no program runs. */
#define PANEL_OFF(in, out0, out1, out2, out3)                                 \
	PANEL_MAP(in, out0 " safe=0", out1 " safe=0", out2 " safe=0", out3 " safe=0")
#define PANEL_PLAIN PANEL_OFF("", "", "", "", "")

/** panel_up - creates it with all pulls down. @hog as for bank_up(). */
void panel_up(int hog);
void panel_down(void);
/** panel_shows - waits until the four outputs have the levels @want, one bit each. */
bool panel_shows(uint32_t want);
/** panel_image - the code image of programs/panel.rung. */
const char *panel_image(void);
#endif
