#!/usr/bin/perl
# SPDX-License-Identifier: MIT
use strict;
use warnings;

open my $out, '>', 'main.rung' or die;
print $out qq{<project xmlns="http://www.plcopen.org/xml/tc6_0201">\n<types>\n}, "<type>\n" x 500,
	'</type>' x 500, "</types></project>\n";
close $out or die;
