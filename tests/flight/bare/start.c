/* SPDX-License-Identifier: Apache-2.0
 * The first instructions of a Cortex-R5, and what it does where it cannot go on.
 * in: reset -> out: _start() with a stack and IEEE arithmetic. docs/flight.md, "Bare metal" */
#define ARM_CODE __attribute__((naked, target("arm"), used))
ARM_CODE __attribute__((section(".vectors"))) void image_vectors(void);
ARM_CODE void image_reset(void);
ARM_CODE void image_fault(void);

/* Reset, undefined instruction, system call, prefetch, data, (none), interrupts. */
void image_vectors(void) {
    __asm__("b image_reset\n\tb image_fault\n\tb image_fault\n\tb image_fault\n\t"
            "b image_fault\n\tb image_fault\n\tb image_fault\n\tb image_fault");
}

/* The floating-point unit is off after reset. In FPSCR 0 means: round to nearest, denormals kept, NaN as
 * they are, no traps. */
void image_reset(void) {
    __asm__("mrc p15, 0, r0, c1, c0, 2\n\t" /* CPACR: whoever runs may use coprocessors 10 and 11 */
            "orr r0, r0, #0xf00000\n\t"
            "mcr p15, 0, r0, c1, c0, 2\n\t"
            "isb\n\t"
            "mov r0, #0x40000000\n\t"
            "vmsr fpexc, r0\n\t"
            "mov r0, #0\n\t"
            "vmsr fpscr, r0\n\t"
            "ldr sp, =image_stack_end\n\t"
            "ldr r0, =_start\n\t"
            "bx r0\n\t"
            ".ltorg");
}

/* Semihosting: the end by a fault, so that whoever waits sees it. */
void image_fault(void) {
    __asm__("mov r0, #0x18\n\t"
            "ldr r1, =0x20023\n\t"
            "svc 0x123456\n\t"
            "b image_fault\n\t"
            ".ltorg");
}
