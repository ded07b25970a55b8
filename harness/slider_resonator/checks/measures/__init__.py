"""What is read off fast signals: slow motion, ripple, dominant frequency, peak deviation.

Tubes in time are of no use here: at 500 Hz and above an identical signal leaves a tube that is
narrow in value, and a sign-flipped one stays inside a tube that is wide in time.
"""
