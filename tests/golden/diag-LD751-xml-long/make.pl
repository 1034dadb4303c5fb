#!/usr/bin/perl
# SPDX-License-Identifier: MIT
use strict;
use warnings;

open my $out, '>', 'main.rung' or die;
print $out qq{<project xmlns="http://www.plcopen.org/xml/tc6_0201">\n<types><pous><pou name="Main" pouType="program"><body><LD>\n},
	qq{<leftPowerRail localId="0"/>\n}, qq{<contact localId="1"><connectionPointIn><connection refLocalId="0"/></connectionPointIn>}
	. qq{<connectionPointOut/><variable>A</variable></contact>\n<contact localId="2"><connectionPointIn><connection refLocalId="0"/>}
	. qq{</connectionPointIn><connectionPointOut/><variable>A</variable></contact>\n},
	(map { my $n = $_; map { qq{<contact localId="@{[$n * 2 + $_]}"><connectionPointIn><connection refLocalId="@{[$n * 2 - 1 - ($_ - 1)]}"/>}
	. qq{<connection refLocalId="@{[$n * 2 - 3 + $_]}"/></connectionPointIn><connectionPointOut/><variable>A</variable></contact>\n} } 1, 2 } 1 .. 60),
	qq{<coil localId="900"><connectionPointIn><connection refLocalId="121"/><connection refLocalId="122"/></connectionPointIn>}
	. qq{<variable>A</variable></coil>\n}, "</LD></body></pou></pous></types></project>\n";
close $out or die;
