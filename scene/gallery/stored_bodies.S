// The file that store_bodies writes, as bytes of the program.
    .section .rodata
    .balign 16
    .global nacreGalleryBodies
    .global nacreGalleryBodiesEnd
nacreGalleryBodies:
    .incbin NACRE_GALLERY_BODIES
nacreGalleryBodiesEnd:
    .section .note.GNU-stack,"",%progbits
